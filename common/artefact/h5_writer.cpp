// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5_content.h"
#include "common/artefact/known_artefacts.h"
#include "common/errors/codes.h"

namespace roomcut {

using h5::Handle;

struct H5Writer::Stream {
  Handle dataset;
  hid_t memory_type = -1;
  std::size_t item_bytes = 0;  ///< of one element
  h5::Shape shape;
  std::uint64_t total = 1;  ///< elements
  std::uint64_t done = 0;
  std::string type;
  bool by_checksums = false;  ///< not hashed here
  Sha256 sha;
};

namespace {
constexpr std::uint64_t kWriteOut = std::uint64_t{4}
                                    << 20;  ///< bytes after which the disk gets something to do
}

struct H5Writer::State {
  AtomicFile atomic;
  Provenance provenance;
  Handle file;
  std::map<std::string, Stream> streams;
  h5::PayloadDigest digest;
  std::uint64_t since_write_out = 0;  ///< bytes

  ArtefactType type;

  State(const std::filesystem::path& path, ArtefactType of_type, const Provenance& from)
      : atomic(path), provenance(from), type(of_type) {}

  [[noreturn]] void failed(const std::string& object) const {
    throw StageError(errors::kCannotWrite, atomic.final_path().string(),
                     "object " + object + " cannot be written: " + h5::last_error(),
                     "see whether the disk is full; nothing of before is lost");
  }
  void require(bool good, const std::string& object) const {
    if (!good) {
      failed(object);
    }
  }
};

namespace {

Handle untimed(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(list.get(), false);
  return list;
}

/// "f32", "i64", "u8" …
std::string type_name(hid_t type) {
  const char* kind = H5Tget_class(type) == H5T_FLOAT ? "f" : H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "i";
  return kind + std::to_string(8 * H5Tget_size(type));
}

/// Makes the groups above `path`.
bool make_parents(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    const std::string group = path.substr(0, slash);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) <= 0) {
      const Handle list = untimed(H5P_GROUP_CREATE);
      const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, list.get(), H5P_DEFAULT), H5Gclose);
      if (!made.valid()) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

H5Writer::H5Writer(const std::filesystem::path& path, ArtefactType type, const Provenance& provenance,
                   const Frame& frame)
    : state_(std::make_unique<State>(path, type, provenance)) {
  h5::prepare_library();
  const Handle creation = untimed(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  state_->file =
      Handle(H5Fcreate(state_->atomic.temporary_path().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
             H5Fclose);
  state_->require(state_->file.valid(), "/");
  attribute("/", "artefact", std::string(type.name));
  attribute("/", "schema_version", version_text(type));
  attribute("/", "writer", provenance.stage);
  for (const char* group : {"/frame", "/provenance"}) {
    state_->require(make_parents(state_->file.get(), std::string(group) + "/"), group);
  }
  attribute("/frame", "unit", frame.unit);
  attribute("/frame", "up", frame.up);
  const std::array<double, 3> origin = std::to_array(frame.origin);
  const Handle group(H5Gopen2(state_->file.get(), "/frame", H5P_DEFAULT), H5Gclose);
  state_->require(h5::write_vector_attribute(group.get(), "origin", origin), "/frame@origin");
  state_->digest.attribute("/frame", "origin", origin);
  if (frame.levelled()) {
    const std::array<double, 3> level = std::to_array(frame.level);
    state_->require(h5::write_vector_attribute(group.get(), "level", level), "/frame@level");
    state_->digest.attribute("/frame", "level", level);
  }
  if (!frame.crs.empty()) {
    attribute("/frame", "crs", frame.crs);
  }
}

H5Writer::~H5Writer() = default;

void H5Writer::begin_raw(const std::string& path, hid_t memory_type, hid_t file_type, std::size_t size,
                         const h5::Shape& shape, std::string_view unit, std::string_view description) {
  h5::prepare_library();
  const std::string name = h5::absolute_path(path);
  if (shape.empty() || state_->streams.contains(name)) {
    throw std::logic_error("dataset " + name + ": no shape, or begun twice");
  }
  Stream stream;
  stream.memory_type = memory_type;
  stream.item_bytes = size;
  stream.shape = shape;
  stream.type = type_name(file_type);
  std::vector<hsize_t> sizes;
  for (const std::uint64_t n : shape) {
    stream.total *= n;
    sizes.push_back(n);
  }
  state_->require(make_parents(state_->file.get(), name), name);
  const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
  const Handle list = untimed(H5P_DATASET_CREATE);
  H5Pset_layout(list.get(), H5D_CONTIGUOUS);
  H5Pset_alloc_time(list.get(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(list.get(),
                   H5D_FILL_TIME_NEVER);  // every element is written before commit() lets the file out
  stream.dataset = Handle(H5Dcreate2(state_->file.get(), name.c_str(), file_type, space.get(), H5P_DEFAULT,
                                     list.get(), H5P_DEFAULT),
                          H5Dclose);
  state_->require(stream.dataset.valid(), name);
  state_->streams.emplace(name, std::move(stream));
  attribute(name, "unit", std::string(unit));
  attribute(name, "description", std::string(description));
}

void H5Writer::append_raw(const std::string& path, const void* data, std::size_t count, std::size_t size) {
  h5::prepare_library();
  const std::string name = h5::absolute_path(path);
  const auto found = state_->streams.find(name);
  if (found == state_->streams.end() || found->second.item_bytes != size) {
    throw std::logic_error("dataset " + name + " was not begun, or with another type");
  }
  Stream& stream = found->second;
  std::uint64_t row = 1;
  for (std::size_t i = 1; i < stream.shape.size(); ++i) {
    row *= stream.shape[i];
  }
  if (count == 0) {
    return;
  }
  if (row == 0 || count % row != 0 || count > stream.total - stream.done) {
    throw std::logic_error("dataset " + name +
                           ": a block that is not made of whole rows, or too many of them");
  }
  std::vector<hsize_t> start(stream.shape.size(), 0);
  std::vector<hsize_t> extent(stream.shape.begin(), stream.shape.end());
  start[0] = stream.done / row;
  extent[0] = count / row;
  const Handle file_space(H5Dget_space(stream.dataset.get()), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                            H5Sclose);
  const bool selected = H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr,
                                            extent.data(), nullptr) >= 0;
  state_->require(selected && H5Dwrite(stream.dataset.get(), stream.memory_type, memory_space.get(),
                                       file_space.get(), H5P_DEFAULT, data) >= 0,
                  name);
  if (!stream.by_checksums) {
    stream.sha.update(data, count * size);
  }
  stream.done += count;
  state_->since_write_out += count * size;
  if (state_->since_write_out >= kWriteOut) {
    state_->atomic.start_writing_out();
    state_->since_write_out = 0;
  }
}

void H5Writer::sum_blocks(const std::string& path, std::int64_t checksum_column) {
  const std::string name = h5::absolute_path(path);
  state_->streams.at(name).by_checksums = true;
  attribute(name, h5::kChecksumColumn, checksum_column);
}

void H5Writer::write_raw(const std::string& path, const void* data, std::size_t count, hid_t memory_type,
                         hid_t file_type, std::size_t size, const h5::Shape& shape, std::string_view unit,
                         std::string_view description) {
  begin_raw(path, memory_type, file_type, size, shape, unit, description);
  append_raw(path, data, count, size);
}

namespace {

template <class Write>
void put_attribute(hid_t file, const std::string& object_path, Write write) {
  const Handle object(H5Oopen(file, object_path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.valid()) {
    throw std::logic_error("no object " + object_path + " to hold an attribute");
  }
  write(object.get());
}

bool in_provenance(const std::string& path) {
  return path == "/provenance" || path.starts_with("/provenance/");
}

}  // namespace

void H5Writer::attribute(const std::string& object_path, const std::string& name, double value) {
  const std::string path = h5::absolute_path(object_path);
  put_attribute(state_->file.get(), path, [&](hid_t object) {
    state_->require(h5::write_number_attribute(object, name, value), path + "@" + name);
  });
  if (!in_provenance(path)) {
    state_->digest.attribute(path, name, value);
  }
}

void H5Writer::attribute(const std::string& object_path, const std::string& name, std::int64_t value) {
  const std::string path = h5::absolute_path(object_path);
  put_attribute(state_->file.get(), path, [&](hid_t object) {
    state_->require(h5::write_number_attribute(object, name, value), path + "@" + name);
  });
  if (!in_provenance(path)) {
    state_->digest.attribute(path, name, value);
  }
}

void H5Writer::attribute(const std::string& object_path, const std::string& name, const std::string& value) {
  const std::string path = h5::absolute_path(object_path);
  put_attribute(state_->file.get(), path, [&](hid_t object) {
    state_->require(h5::write_text_attribute(object, name, value), path + "@" + name);
  });
  if (!in_provenance(path)) {
    state_->digest.attribute(path, name, value);
  }
}

bool H5Writer::commit() {
  for (auto& [name, stream] : state_->streams) {
    if (stream.done != stream.total) {
      throw std::logic_error("dataset " + name + " was promised more elements than it got");
    }
    state_->digest.dataset(name, stream.type, stream.shape,
                           stream.by_checksums ? h5::kByChecksums : stream.sha.hex());
  }
  for (auto& [name, stream] : state_->streams) {
    // What the library has held back is written now; closing a dataset does not tell what could not be.
    state_->require(H5Dflush(stream.dataset.get()) >= 0, name);
  }
  state_->streams.clear();
  const std::string payload = state_->digest.hex();
  const Provenance& provenance = state_->provenance;
  attribute("/provenance", "stage", provenance.stage);
  attribute("/provenance", "stage_revision", static_cast<std::int64_t>(provenance.stage_revision));
  attribute("/provenance", "params_json", provenance.params_json);
  attribute("/provenance", "params_sha256", provenance.params_sha256);
  attribute("/provenance", "payload_sha256", payload);
  state_->require(make_parents(state_->file.get(), "/provenance/inputs/"), "/provenance/inputs");
  for (const InputRecord& input : provenance.inputs) {
    const std::string group = "/provenance/inputs/" + input.name;
    state_->require(make_parents(state_->file.get(), group + "/"), group);
    attribute(group, "artefact", input.artefact);
    attribute(group, "schema_version", input.schema_version);
    attribute(group, "payload_sha256", input.payload_sha256);
    attribute(group, "path", input.path);
  }
  // Flushed first: a file that cannot be flushed cannot be closed either, and then the flush's reason is
  // lost.
  state_->require(H5Fflush(state_->file.get(), H5F_SCOPE_LOCAL) >= 0, "/");
  state_->require(state_->file.try_close(), "/");
  const bool same = stated_payload(state_->atomic.final_path()) == payload;
  state_->atomic.commit(same);
  remember_artefact(state_->atomic.final_path(),
                    {"", state_->type.name, version_text(state_->type), payload, ""});
  return !same;
}

}  // namespace roomcut
