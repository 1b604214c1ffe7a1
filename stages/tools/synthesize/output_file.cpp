// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/output_file.h"

#include <sys/types.h>

#include <charconv>

#include "common/errors/codes.h"

namespace roomcut::synthesize {

OutputFile::OutputFile(const std::filesystem::path& path)
    : file_(path), stream_(std::fopen(file_.temporary_path().c_str(), "wb"), &std::fclose) {
  check(stream_ != nullptr);
}

void OutputFile::write(const void* data, std::size_t bytes) {
  check(std::fwrite(data, 1, bytes, stream_.get()) == bytes);
  size_ += bytes;
}

void OutputFile::overwrite(std::uint64_t place, std::string_view text) {
  check(::fseeko(stream_.get(), static_cast<off_t>(place), SEEK_SET) == 0);
  check(std::fwrite(text.data(), 1, text.size(), stream_.get()) == text.size());
  check(::fseeko(stream_.get(), 0, SEEK_END) == 0);
}

void OutputFile::commit() {
  check(std::fclose(stream_.release()) == 0);
  file_.commit();
}

void OutputFile::check(bool good) const {
  if (!good) {
    throw StageError(errors::kCannotWrite, file_.final_path().string(), "cannot be written",
                     "is the disk full?");
  }
}

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

}  // namespace roomcut::synthesize
