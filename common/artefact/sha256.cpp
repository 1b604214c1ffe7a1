// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/sha256.h"

#include <fcntl.h>
// The functions below OpenSSL's EVP layer: that layer looks for providers and their configuration when it is
// first used, which takes longer than all the digests of a small stage.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "common/errors/codes.h"

namespace roomcut {

struct Sha256::State {
  SHA256_CTX context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  if (SHA256_Init(&state_->context) != 1) {
    throw std::runtime_error("OpenSSL offers no SHA-256");
  }
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(const void* data, std::size_t bytes) {
  if (SHA256_Update(&state_->context, data, bytes) != 1) {
    throw std::runtime_error("SHA-256 failed");
  }
}

std::string Sha256::hex() {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  if (SHA256_Final(digest.data(), &state_->context) != 1) {
    throw std::runtime_error("SHA-256 failed");
  }
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * digest.size());
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string sha256_hex(std::string_view text) {
  Sha256 sha;
  sha.update(text);
  return sha.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  const auto refuse = [&path] {
    throw StageError(errors::kArtefactMissing, path.string(),
                     std::string("cannot be read: ") + std::strerror(errno));
  };
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    refuse();
  }
  ::posix_fadvise(file, 0, 0, POSIX_FADV_SEQUENTIAL);
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::vector<char> block(kBlock);
  Sha256 sha;
  for (;;) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      const int why = errno;
      ::close(file);
      errno = why;
      refuse();
    }
    if (got == 0) {
      break;
    }
    sha.update(block.data(), static_cast<std::size_t>(got));
  }
  ::close(file);
  return sha.hex();
}

}  // namespace roomcut
