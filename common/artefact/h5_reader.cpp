// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <cstring>
#include <limits>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5_detail.h"
#include "common/artefact/known_artefacts.h"
#include "common/errors/codes.h"

namespace roomcut {

using h5::Handle;

struct H5Reader::State {
  std::filesystem::path path;
  Handle file;
  Frame frame;
  Provenance provenance;
  std::string payload;
  std::string opened;  ///< path of `dataset`
  Handle dataset;      ///< the one asked for last: first its shape is asked for, then its values

  hid_t open(const std::string& dataset_path);
};

namespace {

constexpr const char* kRemedy = "make it again: delete the file and run make";

[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& object,
                                const std::string& what) {
  throw StageError(errors::kArtefactDamaged, path.string() + ": " + h5::absolute_path(object), what, kRemedy);
}

Handle open_artefact(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw StageError(errors::kArtefactMissing, path.string(), "there is no such file",
                     "run the stage that writes it (make run makes all of them)");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw StageError(errors::kArtefactMissing, path.string(), "is not a file");
  }
  Handle file = h5::open_for_reading(path);
  if (!file.valid()) {
    throw StageError(errors::kArtefactDamaged, path.string(), "cannot be opened as HDF5: " + h5::last_error(),
                     kRemedy);
  }
  return file;
}

h5::Shape shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> sizes(dimensions > 0 ? static_cast<std::size_t>(dimensions) : 0);
  if (!sizes.empty()) {
    H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr);
  }
  return {sizes.begin(), sizes.end()};
}

class AttributeReader {
 public:
  AttributeReader(const std::filesystem::path& file_path, hid_t file, const std::string& object_path)
      : file_path_(file_path),
        path_(h5::absolute_path(object_path)),
        object_(H5Oopen(file, path_.c_str(), H5P_DEFAULT), H5Oclose) {}
  std::string text(const std::string& name) const {
    std::string value;
    require(object_.valid() && h5::read_text_attribute(object_.get(), name, value), name);
    return value;
  }
  double number(const std::string& name) const {
    double value = 0;
    require(object_.valid() && h5::read_number_attribute(object_.get(), name, value), name);
    return value;
  }
  std::int64_t integer(const std::string& name) const {
    std::int64_t value = 0;
    require(object_.valid() && h5::read_number_attribute(object_.get(), name, value), name);
    return value;
  }

 private:
  void require(bool good, const std::string& name) const {
    if (!good) {
      throw_damaged(file_path_, path_, "attribute " + name + " is missing or of another type");
    }
  }
  const std::filesystem::path& file_path_;
  std::string path_;
  Handle object_;
};

std::vector<std::string> children(hid_t file, const std::string& group_path) {
  std::vector<std::string> names;
  const Handle group(H5Gopen2(file, group_path.c_str(), H5P_DEFAULT), H5Gclose);
  const auto collect = [](hid_t /*group*/, const char* name, const H5L_info_t* /*info*/,
                          void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (group.valid()) {
    H5Literate(group.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
  }
  return names;
}

Provenance read_provenance(const std::filesystem::path& path, hid_t file) {
  Provenance provenance;
  const AttributeReader root(path, file, "/provenance");
  provenance.stage = root.text("stage");
  provenance.stage_revision = static_cast<int>(root.integer("stage_revision"));
  provenance.params_json = root.text("params_json");
  provenance.params_sha256 = root.text("params_sha256");
  for (const std::string& name : children(file, "/provenance/inputs")) {
    const AttributeReader input(path, file, "/provenance/inputs/" + name);
    provenance.inputs.push_back({name, input.text("artefact"), input.text("schema_version"),
                                 input.text("payload_sha256"), input.text("path")});
  }
  return provenance;
}

}  // namespace

hid_t H5Reader::State::open(const std::string& dataset_path) {
  h5::prepare_library();
  const std::string name = h5::absolute_path(dataset_path);
  if (opened != name) {
    opened.clear();
    dataset = Handle(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) {
      throw_damaged(path, dataset_path, "the dataset is missing");
    }
    opened = name;
  }
  return dataset.get();
}

H5Reader::H5Reader(const std::filesystem::path& path, ArtefactType expected)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->file = open_artefact(path);
  const hid_t file = state_->file.get();
  const Handle root(H5Oopen(file, "/", H5P_DEFAULT), H5Oclose);
  std::string artefact;
  std::string version;
  h5::read_text_attribute(root.get(), "artefact", artefact);
  h5::read_text_attribute(root.get(), "schema_version", version);
  check_type_and_version(path, artefact, version, expected);
  const AttributeReader frame(path, file, "/frame");
  state_->frame.unit = frame.text("unit");
  state_->frame.up = frame.text("up");
  const Handle group(H5Gopen2(file, "/frame", H5P_DEFAULT), H5Gclose);
  if (!h5::read_vector_attribute(group.get(), "origin", state_->frame.origin)) {
    throw_damaged(path, "/frame", "attribute origin is missing or of another type");
  }
  if (H5Aexists(group.get(), "level") > 0 &&
      !h5::read_vector_attribute(group.get(), "level", state_->frame.level)) {
    throw_damaged(path, "/frame", "attribute level is of another type");
  }
  state_->provenance = read_provenance(path, file);
  state_->payload = AttributeReader(path, file, "/provenance").text("payload_sha256");
  remember_artefact(path, {"", artefact, version, state_->payload, ""});
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
  return state_->path;
}

void H5Reader::damaged(const std::string& object_path, const std::string& what) const {
  throw_damaged(state_->path, object_path, what);
}

bool H5Reader::exists(const std::string& path) const {
  const std::string name = h5::absolute_path(path);
  for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    if (H5Lexists(state_->file.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) {
      return false;
    }
    if (slash == std::string::npos) {
      return true;
    }
  }
}

h5::Shape H5Reader::checked_shape(const std::string& path, const h5::Shape& expected) const {
  const hid_t dataset = state_->open(path);
  h5::Shape actual = shape_of(dataset);
  bool fits = !actual.empty() && (expected.empty() || expected.size() == actual.size());
  for (std::size_t i = 0; fits && i < expected.size(); ++i) {
    fits = expected[i] == 0 || expected[i] == actual[i];
  }
  if (!fits) {
    damaged(path, "the dataset has an unexpected shape");
  }
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (h5::type_name(type.get()).empty()) {
    damaged(path, "the dataset does not hold numbers");
  }
  // A header may promise anything: the bytes must be there before anybody makes room for them.
  std::uint64_t bytes = H5Tget_size(type.get());
  for (const std::uint64_t n : actual) {
    if (n != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / n) {
      damaged(path, "the dataset claims an impossible size");
    }
    bytes *= n;
  }
  if (bytes > 0 && H5Dget_storage_size(dataset) == 0) {
    damaged(path, "the dataset has no data");
  }
  if (bytes > 0 && H5Dget_offset(dataset) != HADDR_UNDEF) {
    hsize_t end = 0;
    H5Fget_filesize(state_->file.get(), &end);
    const std::uint64_t begin = H5Dget_offset(dataset);
    if (begin > end || bytes > end - begin) {
      damaged(path, "the file ends before the dataset does");
    }
  }
  return actual;
}

std::uint64_t H5Reader::contiguous_offset(const std::string& path) const {
  const hid_t dataset = state_->open(path);
  const haddr_t offset = H5Dget_offset(dataset);
  if (offset == HADDR_UNDEF) {
    damaged(path, "the dataset is not contiguous, or empty");
  }
  return offset;
}

void H5Reader::read_raw(const std::string& path, void* out, hid_t memory_type, std::uint64_t first,
                        std::uint64_t count) const {
  if (count == 0) {
    return;
  }
  const hid_t dataset = state_->open(path);
  const h5::Shape shape = shape_of(dataset);
  if (shape.empty() || first > shape[0] || count > shape[0] - first) {
    damaged(path, "the dataset has fewer rows than expected");
  }
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(type.get()) != H5Tget_class(memory_type)) {
    damaged(path, "the dataset holds another type of number");
  }
  std::vector<hsize_t> start(shape.size(), 0);
  std::vector<hsize_t> extent(shape.begin(), shape.end());
  start[0] = first;
  extent[0] = count;
  const Handle file_space(H5Dget_space(dataset), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                            H5Sclose);
  H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  if (H5Dread(dataset, memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, out) < 0) {
    damaged(path, "the dataset cannot be read: " + h5::last_error());
  }
}

double H5Reader::attribute_double(const std::string& object_path, const std::string& name) const {
  return AttributeReader(state_->path, state_->file.get(), object_path).number(name);
}
std::int64_t H5Reader::attribute_int(const std::string& object_path, const std::string& name) const {
  return AttributeReader(state_->path, state_->file.get(), object_path).integer(name);
}
std::string H5Reader::attribute_string(const std::string& object_path, const std::string& name) const {
  return AttributeReader(state_->path, state_->file.get(), object_path).text(name);
}

}  // namespace roomcut
