// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/page_template.h"

#define ZLIB_CONST  // zlib then promises to only read its input
#include <zlib.h>

#include <stdexcept>

#include "common/picture/svg.h"

namespace roomcut {

namespace {

constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, with a gzip header
constexpr int kMemory = 9;
constexpr int kQuick = 3;

}  // namespace

std::string gzip(std::string_view bytes, bool noisy) {
  z_stream stream{};
  if (deflateInit2(&stream, kQuick, Z_DEFLATED, kGzipWindow, kMemory, noisy ? Z_RLE : Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::runtime_error("zlib cannot begin");
  }
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) {
    throw std::runtime_error("zlib cannot finish");
  }
  return packed;
}

std::string fill_template(std::string_view page_template, const std::vector<PageBlock>& blocks) {
  const std::size_t mark = page_template.find(kDataMark);
  if (mark == std::string_view::npos) {
    throw std::invalid_argument("the page's template has no place for data");
  }
  std::string page(page_template.substr(0, mark));
  for (const PageBlock& block : blocks) {
    const std::string packed = gzip(block.bytes, block.noisy);
    page += "<script type=\"application/octet-stream\" id=\"block-" + block.name + "\">";
    page += base64({reinterpret_cast<const std::uint8_t*>(packed.data()), packed.size()});
    page += "</script>\n";
  }
  page += page_template.substr(mark + kDataMark.size());
  return page;
}

}  // namespace roomcut
