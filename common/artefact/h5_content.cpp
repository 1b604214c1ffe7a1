// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_content.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "common/artefact/artefact_check.h"

namespace roomcut::h5 {

Descriptor::Descriptor(const std::filesystem::path& path)
    : id_(::open(path.c_str(),
                 O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {  // opening a pipe would wait for a writer
  struct stat status {};
  if (id_ < 0) {
    throw_unreadable(path, errno);
  }
  if (::fstat(id_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(id_);
    throw_unreadable(path, S_ISDIR(status.st_mode) ? EISDIR : EINVAL);
  }
}

Descriptor::~Descriptor() {
  if (id_ >= 0) {
    ::close(id_);
  }
}

namespace {

std::uint64_t bytes_of(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

bool in_provenance(const std::string& object_path) {
  return object_path == "/provenance" || object_path.starts_with("/provenance/");
}

}  // namespace

std::string text_of(const StoredObject& object, const std::string& name) {
  const auto found = object.attributes.find(name);
  const bool text = found != object.attributes.end() && std::holds_alternative<std::string>(found->second);
  return text ? std::get<std::string>(found->second) : "";
}

Content::Content(const std::filesystem::path& path, const ArtefactType* expected) : path_(path), file_(path) {
  try {
    Parser parser(file_.get(), bytes_of(file_.get()));
    if (expected != nullptr) {
      const StoredObject root = parser.root();
      check_type_and_version(path_, text_of(root, "artefact"), text_of(root, "schema_version"), *expected);
    }
    objects_ = parser.objects();
  } catch (const Malformed& trouble) {
    throw_damaged(path_, trouble.object, trouble.what);
  }
}

InputRecord Content::stated() const {
  InputRecord record;
  record.artefact = text_of(objects_.at("/"), "artefact");
  record.schema_version = text_of(objects_.at("/"), "schema_version");
  if (const auto provenance = objects_.find("/provenance"); provenance != objects_.end()) {
    record.payload_sha256 = text_of(provenance->second, "payload_sha256");
  }
  return record;
}

const StoredDataset& Content::dataset(const std::string& object_path) const {
  const auto found = objects_.find(absolute_path(object_path));
  if (found == objects_.end() || !found->second.dataset) {
    throw_damaged(path_, absolute_path(object_path), "the dataset is missing");
  }
  return *found->second.dataset;
}

void Content::lacks_attribute(const std::string& object_path, const std::string& name) const {
  throw_damaged(path_, absolute_path(object_path), "attribute " + name + " is missing or of another type");
}

void Content::read(const std::string& object_path, const StoredDataset& dataset, std::uint64_t first,
                   std::uint64_t count, void* out) const {
  std::uint64_t done = 0;
  while (done < count) {
    const ssize_t got = ::pread(file_.get(), static_cast<char*>(out) + done, count - done,
                                static_cast<off_t>(dataset.offset + first + done));
    if (got <= 0 && !(got < 0 && errno == EINTR)) {
      throw_damaged(path_, absolute_path(object_path), "the dataset cannot be read");
    }
    done += got > 0 ? static_cast<std::uint64_t>(got) : 0;
  }
}

std::string Content::sha256_of(const std::string& object_path, const StoredDataset& dataset) const {
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 19;
  Sha256 sha;
  std::vector<char> piece(std::min(kPiece, dataset.bytes));
  for (std::uint64_t first = 0; first < dataset.bytes; first += kPiece) {
    const std::uint64_t count = std::min(kPiece, dataset.bytes - first);
    read(object_path, dataset, first, count, piece.data());
    sha.update(piece.data(), count);
  }
  return sha.hex();
}

std::string Content::payload_sha256() const {
  PayloadDigest digest;
  for (const auto& [object_path, object] : objects_) {
    if (in_provenance(object_path)) {
      continue;
    }
    for (const auto& [name, value] : object.attributes) {
      std::visit([&, &key = name, &of = object_path](const auto& held) { digest.attribute(of, key, held); },
                 value);
    }
    if (object.dataset) {
      digest.dataset(object_path, object.dataset->type, object.dataset->shape,
                     object.attributes.contains(kChecksumColumn) ? kByChecksums
                                                                 : sha256_of(object_path, *object.dataset));
    }
  }
  return digest.hex();
}

}  // namespace roomcut::h5
