// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_parser.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

#include "common/artefact/h5_messages.h"
#include "common/artefact/json.h"

namespace roomcut::h5 {

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 24;  ///< of one structure: headers, heaps of names
constexpr std::size_t kMostObjects = 4096;
constexpr int kDeepestTree = 8;

void expect(bool good, const char* what) {
  if (!good) {
    throw Malformed{"", what};
  }
}

void expect_signature(ByteReader& reader, std::string_view signature) {
  const auto found = reader.take(signature.size());
  expect(std::equal(found.begin(), found.end(), signature.begin(), signature.end(),
                    [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }),
         "a structure of the file is damaged");
}

/// One entry of a group.
struct Entry {
  std::uint64_t name_offset, header;
  std::uint32_t cached;

  explicit Entry(ByteReader& reader)
      : name_offset(reader.number<std::uint64_t>()),
        header(reader.number<std::uint64_t>()),
        cached(reader.number<std::uint32_t>()) {
    reader.take(20);  // reserved, scratch
    constexpr std::uint32_t kSoftLink = 2;
    expect(cached < kSoftLink, "a link to another place, which artefacts do not have");
  }
};

}  // namespace

struct Parser::Header {
  std::vector<Message> messages;
};

/// A group that is being visited: the names of its members, and where their objects go.
struct Parser::Group {
  std::string prefix;  ///< "/levels/"
  Bytes names;
  std::map<std::string, StoredObject>& objects;

  std::string name(std::uint64_t offset) const {
    expect(offset < names.size(), "a name lies outside the names of its group");
    const auto begin = names.begin() + static_cast<std::ptrdiff_t>(offset);
    const auto end = std::find(begin, names.end(), std::uint8_t{0});
    std::string text(begin, end);
    expect(end != names.end() && !text.empty() && text.find('/') == std::string::npos && is_utf8(text),
           "the name of an object is no text");
    return text;
  }
};

Parser::Parser(int descriptor, std::uint64_t file_bytes) : descriptor_(descriptor), file_bytes_(file_bytes) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  constexpr std::size_t kSuperblock = 96;
  expect(file_bytes >= kSuperblock, "is no HDF5 file, or its beginning is damaged");
  const Bytes block = bytes(0, kSuperblock);
  expect(std::equal(kSignature.begin(), kSignature.end(), block.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }),
         "is no HDF5 file, or its beginning is damaged");
  ByteReader reader(block);
  reader.take(kSignature.size());
  const auto versions = reader.take(5);
  const auto address_size = reader.number<std::uint8_t>();
  const auto length_size = reader.number<std::uint8_t>();
  reader.take(1 + 4 + 4);  // reserved, widths of trees, flags
  const auto base = reader.number<std::uint64_t>();
  reader.take(8);  // free space
  const auto end = reader.number<std::uint64_t>();
  reader.take(8);  // driver
  expect(std::all_of(versions.begin(), versions.end(), [](std::uint8_t v) { return v == 0; }) &&
             address_size == 8 && length_size == 8 && base == 0,
         "its beginning is damaged, or it is HDF5 of a kind that artefacts are not");
  expect(end <= file_bytes, "the file is shorter than it was when it was written");
  root_ = Entry(reader).header;
}

StoredObject Parser::root() {
  const StoredObject found = object(header(root_), "/");
  visited_.clear();
  return found;
}

std::map<std::string, StoredObject> Parser::objects() {
  std::map<std::string, StoredObject> found;
  visit(root_, "/", found);
  visited_.clear();
  return found;
}

Parser::Bytes Parser::bytes(std::uint64_t address, std::uint64_t count) const {
  expect(address <= file_bytes_ && count <= file_bytes_ - address && count <= kMostBytes,
         "a structure of the file lies beyond its end, or is impossibly long");
  Bytes data(count);
  std::uint64_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(descriptor_, data.data() + done, count - done, static_cast<off_t>(address + done));
    expect(got > 0 || (got < 0 && errno == EINTR), "cannot be read");
    done += got > 0 ? static_cast<std::uint64_t>(got) : 0;
  }
  return data;
}

void Parser::once(std::uint64_t address) {
  expect(visited_.emplace(address, true).second, "a structure of the file is used twice");
  expect(visited_.size() <= 4 * kMostObjects, "holds more objects than an artefact can have");
}

/// The messages of an object, with those of its continuation blocks.
Parser::Header Parser::header(std::uint64_t address) {
  constexpr std::size_t kPrefix = 16;
  once(address);
  const Bytes prefix = bytes(address, kPrefix);
  ByteReader reader(prefix);
  const auto version = reader.number<std::uint8_t>();
  reader.take(1);
  const std::size_t count = reader.number<std::uint16_t>();
  reader.take(4);  // times it is linked to
  expect(version == 1, "the header of an object is damaged");
  std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks{
      {address + kPrefix, reader.number<std::uint32_t>()}};
  Header header;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Bytes block = bytes(blocks[b].first, blocks[b].second);
    ByteReader messages(block);
    while (header.messages.size() < count && messages.left() >= 8) {
      Message message{static_cast<MessageType>(messages.number<std::uint16_t>()), 0, {}};
      const std::size_t size = messages.number<std::uint16_t>();
      message.flags = messages.number<std::uint8_t>();
      messages.take(3);
      const auto data = messages.take(size);
      message.data.assign(data.begin(), data.end());
      if (message.type == MessageType::kContinuation) {
        ByteReader next(data);
        const auto at = next.number<std::uint64_t>();
        once(at);
        blocks.emplace_back(at, next.number<std::uint64_t>());
      }
      header.messages.push_back(std::move(message));
    }
  }
  expect(header.messages.size() == count, "the header of an object ends too early");
  return header;
}

StoredObject Parser::object(const Header& header, const std::string& path) const {
  constexpr std::uint8_t kShared = 2;
  StoredObject stored;
  try {
    bool data = false;
    for (const Message& message : header.messages) {
      data = data || message.type == MessageType::kLayout || message.type == MessageType::kDatatype;
      expect((message.flags & kShared) == 0 && message.type != MessageType::kAttributeInfo &&
                 message.type != MessageType::kLinkInfo && message.type != MessageType::kLink,
             "is of a kind that artefacts do not have");
      if (message.type == MessageType::kAttribute) {
        expect(stored.attributes.insert(parse_attribute(message.data)).second, "an attribute stands twice");
      }
    }
    if (data) {
      stored.dataset = parse_dataset(header.messages, file_bytes_);
    }
  } catch (const Malformed& trouble) {
    throw Malformed{path, trouble.what};
  }
  return stored;
}

void Parser::visit(std::uint64_t address, const std::string& path,
                   std::map<std::string, StoredObject>& objects) {
  Header found;
  try {
    expect(objects.size() < kMostObjects && std::count(path.begin(), path.end(), '/') <= kDeepestTree,
           "holds more objects than an artefact can have");
    found = header(address);
  } catch (const Malformed& trouble) {
    throw Malformed{path, trouble.what};
  }
  objects[path] = object(found, path);
  for (const Message& message : found.messages) {
    if (message.type == MessageType::kSymbolTable) {
      ByteReader reader(message.data);
      const auto tree = reader.number<std::uint64_t>();
      const Bytes heap = bytes(reader.number<std::uint64_t>(), 32);
      ByteReader heap_reader(heap);
      expect_signature(heap_reader, "HEAP");
      heap_reader.take(4);
      const auto size = heap_reader.number<std::uint64_t>();
      heap_reader.take(8);
      const Group group{path == "/" ? path : path + "/", bytes(heap_reader.number<std::uint64_t>(), size),
                        objects};
      visit_node(tree, group, kDeepestTree);
    }
  }
}

/// A node of the tree of a group's members; its leaves are tables of entries.
void Parser::visit_node(std::uint64_t address, const Group& group, int level) {
  once(address);
  const Bytes head = bytes(address, 24);
  ByteReader reader(head);
  expect_signature(reader, "TREE");
  const auto type = reader.number<std::uint8_t>();
  const int height = reader.number<std::uint8_t>();
  const std::uint64_t count = reader.number<std::uint16_t>();
  expect(type == 0 && height < level, "a structure of the file is damaged");
  const Bytes body = bytes(address + head.size(), 16 * count + 8);
  ByteReader children(body);
  for (std::uint64_t i = 0; i < count; ++i) {
    children.take(8);  // key
    const auto child = children.number<std::uint64_t>();
    if (height == 0) {
      visit_leaf(child, group);
    } else {
      visit_node(child, group, height);
    }
  }
}

void Parser::visit_leaf(std::uint64_t address, const Group& group) {
  constexpr std::uint64_t kEntry = 40;
  once(address);
  const Bytes head = bytes(address, 8);
  ByteReader reader(head);
  expect_signature(reader, "SNOD");
  reader.take(2);
  const std::uint64_t count = reader.number<std::uint16_t>();
  const Bytes body = bytes(address + head.size(), count * kEntry);
  ByteReader entries(body);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Entry entry(entries);
    const std::string path = group.prefix + group.name(entry.name_offset);
    expect(!group.objects.contains(path), "a name stands twice in a group");
    visit(entry.header, path, group.objects);
  }
}

}  // namespace roomcut::h5
