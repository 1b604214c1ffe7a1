// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5_content.h"
#include "common/artefact/known_artefacts.h"

namespace roomcut {

struct H5Reader::State {
  h5::Content content;
  Frame frame;
  Provenance provenance;
  std::string payload;
};

namespace {

Frame frame_of(const h5::Content& content) {
  Frame frame;
  frame.unit = content.attribute<std::string>("/frame", "unit");
  frame.up = content.attribute<std::string>("/frame", "up");
  const auto& origin = content.attribute<std::array<double, 3>>("/frame", "origin");
  std::copy(origin.begin(), origin.end(), std::begin(frame.origin));
  if (content.objects().at("/frame").attributes.contains("level")) {  // of scans that were levelled
    const auto& level = content.attribute<std::array<double, 3>>("/frame", "level");
    std::copy(level.begin(), level.end(), std::begin(frame.level));
  }
  if (content.objects().at("/frame").attributes.contains("crs")) {  // of scans that name theirs
    frame.crs = content.attribute<std::string>("/frame", "crs");
  }
  require_sane(content.path(), frame);
  return frame;
}

Provenance provenance_of(const h5::Content& content) {
  const std::string root = "/provenance";
  const std::string inputs = root + "/inputs/";
  Provenance provenance;
  provenance.stage = content.attribute<std::string>(root, "stage");
  provenance.stage_revision = static_cast<int>(content.attribute<std::int64_t>(root, "stage_revision"));
  provenance.params_json = content.attribute<std::string>(root, "params_json");
  provenance.params_sha256 = content.attribute<std::string>(root, "params_sha256");
  for (auto found = content.objects().lower_bound(inputs);
       found != content.objects().end() && found->first.starts_with(inputs); ++found) {
    const auto word = [&](const char* name) { return content.attribute<std::string>(found->first, name); };
    provenance.inputs.push_back({found->first.substr(inputs.size()), word("artefact"), word("schema_version"),
                                 word("payload_sha256"), word("path")});
  }
  return provenance;
}

}  // namespace

H5Reader::H5Reader(const std::filesystem::path& path, ArtefactType expected) {
  h5::Content content(path, &expected);
  Frame frame = frame_of(content);
  Provenance provenance = provenance_of(content);
  require_params(path, provenance);
  std::string payload = content.attribute<std::string>("/provenance", "payload_sha256");
  require_payload(path, payload, content.payload_sha256());
  remember_artefact(path, content.stated());
  state_ = std::make_unique<State>(
      State{std::move(content), std::move(frame), std::move(provenance), std::move(payload)});
}

H5Reader::~H5Reader() = default;
H5Reader::H5Reader(H5Reader&&) noexcept = default;

const Frame& H5Reader::frame() const {
  return state_->frame;
}
const Provenance& H5Reader::provenance() const {
  return state_->provenance;
}
const std::string& H5Reader::payload_sha256() const {
  return state_->payload;
}
const std::filesystem::path& H5Reader::path() const {
  return state_->content.path();
}
const h5::Content& H5Reader::content() const {
  return state_->content;
}

void H5Reader::damaged(const std::string& object_path, const std::string& what) const {
  throw_damaged(path(), h5::absolute_path(object_path), what);
}

bool H5Reader::exists(const std::string& path) const {
  return state_->content.objects().contains(h5::absolute_path(path));
}

h5::Shape H5Reader::checked_shape(const std::string& path, const h5::Shape& expected) const {
  const h5::Shape& actual = state_->content.dataset(path).shape;
  bool fits = expected.empty() || expected.size() == actual.size();
  for (std::size_t i = 0; fits && i < expected.size(); ++i) {
    fits = expected[i] == 0 || expected[i] == actual[i];
  }
  if (!fits) {
    damaged(path, "the dataset has an unexpected shape");
  }
  return actual;
}

std::uint64_t H5Reader::contiguous_offset(const std::string& path) const {
  const h5::StoredDataset& dataset = state_->content.dataset(path);
  if (dataset.bytes == 0) {
    damaged(path, "the dataset is empty");
  }
  return dataset.offset;
}

void H5Reader::require_type(const std::string& path, const std::string& type) const {
  if (state_->content.dataset(path).type != type) {
    damaged(path, "the dataset holds another type of number");
  }
}

void H5Reader::read_raw(const std::string& path, void* out, std::uint64_t first, std::uint64_t count) const {
  const h5::StoredDataset& dataset = state_->content.dataset(path);
  const std::uint64_t rows = dataset.shape[0];
  if (first > rows || count > rows - first) {
    damaged(path, "the dataset has fewer rows than expected");
  }
  if (dataset.bytes > 0) {
    const std::uint64_t row = dataset.bytes / rows;
    state_->content.read(path, dataset, first * row, count * row, out);
  }
}

double H5Reader::attribute_double(const std::string& object_path, const std::string& name) const {
  return state_->content.attribute<double>(object_path, name);
}
std::int64_t H5Reader::attribute_int(const std::string& object_path, const std::string& name) const {
  return state_->content.attribute<std::int64_t>(object_path, name);
}
std::string H5Reader::attribute_string(const std::string& object_path, const std::string& name) const {
  return state_->content.attribute<std::string>(object_path, name);
}

}  // namespace roomcut
