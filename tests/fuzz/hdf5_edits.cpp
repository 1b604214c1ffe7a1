// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/hdf5_edits.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>

#include "common/artefact/atomic_file.h"
#include "common/artefact/h5_detail.h"
#include "tests/fuzz/target.h"

namespace roomcut::fuzz {

using h5::Handle;

namespace {

const std::string& seed_bytes(std::string_view seed) {
  static std::map<std::string, std::string, std::less<>> known;
  const auto found = known.find(seed);
  return found != known.end() ? found->second
                              : known.emplace(seed, read_text_file(seeds() / seed)).first->second;
}

Handle open_image(const std::string& bytes) {
  h5::prepare_library();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), std::size_t{1} << 20, false);
  H5Pset_file_image(access.get(), const_cast<char*>(bytes.data()), bytes.size());
  return {H5Fopen("image", H5F_ACC_RDWR, access.get()), H5Fclose};
}

std::string image_of(const Handle& file) {
  H5Fflush(file.get(), H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file.get(), nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(0, size)), '\0');
  H5Fget_file_image(file.get(), bytes.data(), bytes.size());
  return bytes;
}

hid_t type_of(const std::string& name) {
  static const std::map<std::string, hid_t> kTypes{
      {"f32", H5T_IEEE_F32LE}, {"f64", H5T_IEEE_F64LE}, {"u8", H5T_STD_U8LE},   {"i8", H5T_STD_I8LE},
      {"u16", H5T_STD_U16LE},  {"i16", H5T_STD_I16LE},  {"u32", H5T_STD_U32LE}, {"i32", H5T_STD_I32LE},
      {"u64", H5T_STD_U64LE},  {"i64", H5T_STD_I64LE}};
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? H5T_IEEE_F64LE : found->second;
}

/// One dataset, taken out of the file, changed, and put back as another one.
struct Values {
  Handle type;
  std::vector<hsize_t> shape;
  std::vector<char> bytes;

  std::size_t item() const { return H5Tget_size(type.get()); }
  hsize_t count() const {
    hsize_t n = 1;
    for (const hsize_t size : shape) n *= size;
    return n;
  }
};

constexpr hsize_t kMostItems = 1 << 20;  ///< of a dataset that is really written

Values take(hid_t dataset) {
  Values values{Handle(H5Dget_type(dataset), H5Tclose), {}, {}};
  const Handle space(H5Dget_space(dataset), H5Sclose);
  values.shape.resize(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), values.shape.data(), nullptr);
  if (values.count() > kMostItems) {  // a claim; as good as empty
    values.shape.assign(1, 0);
  } else {
    values.bytes.resize(values.count() * values.item());
    H5Dread(dataset, values.type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.bytes.data());
  }
  return values;
}

/// "nan", "-inf", "1e308", "0x7fffffff" never fail; words are 0.
void put_number(Values& values, hsize_t index, const std::string& text) {
  std::array<char, 8> raw{};
  if (H5Tget_class(values.type.get()) == H5T_FLOAT) {
    const double value = std::strtod(text.c_str(), nullptr);
    const auto narrow = std::abs(value) > 3e38 ? static_cast<float>(std::copysign(HUGE_VAL, value))
                                               : static_cast<float>(value);
    std::memcpy(raw.data(), values.item() == 4 ? static_cast<const void*>(&narrow) : &value,
                std::min<std::size_t>(8, values.item()));
  } else {
    const long long value = text.starts_with("-")
                                ? std::strtoll(text.c_str(), nullptr, 0)
                                : static_cast<long long>(std::strtoull(text.c_str(), nullptr, 0));
    std::memcpy(raw.data(), &value, raw.size());
  }
  const std::size_t at = index * values.item();
  if (at + values.item() <= values.bytes.size()) {
    std::memcpy(values.bytes.data() + at, raw.data(), std::min<std::size_t>(8, values.item()));
  }
}

void put_back(hid_t file, const std::string& path, const Values& values, hid_t type, hsize_t claimed_rows) {
  std::vector<hsize_t> shape = values.shape;
  const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.get(), false);
  if (claimed_rows > 0 && !shape.empty()) {
    std::vector<hsize_t> chunk(shape.size(), 1);
    chunk[0] = std::min<hsize_t>(claimed_rows, 4096);  // few, should a later edit fill them
    shape[0] = claimed_rows;
    H5Pset_chunk(list.get(), static_cast<int>(chunk.size()), chunk.data());
  } else if (shape.empty() || values.count() > 0) {
    H5Pset_alloc_time(list.get(), H5D_ALLOC_TIME_EARLY);
  }
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle made(H5Dcreate2(file, path.c_str(), type, space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
                    H5Dclose);
  if (claimed_rows == 0 && !values.bytes.empty()) {
    H5Dwrite(made.get(), values.type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.bytes.data());
  }
  h5::write_text_attribute(made.get(), "unit", "1");
  h5::write_text_attribute(made.get(), "description", "edited");
}

void edit_dataset(hid_t file, const std::string& verb, const std::string& path, std::istream& rest) {
  Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) {
    return;
  }
  Values values = take(dataset.get());
  std::string first;
  std::string second;
  rest >> first >> second;
  const auto number = static_cast<hsize_t>(std::strtoull(first.c_str(), nullptr, 0));
  if (verb == "set" || verb == "fill") {
    const hsize_t count = values.count();
    const hsize_t begin = verb == "set" && count > 0 ? number % count : 0;
    for (hsize_t i = begin; i < (verb == "set" ? begin + 1 : count); ++i) {
      put_number(values, i, verb == "set" ? second : first);
    }
    if (!values.bytes.empty()) {
      H5Dwrite(dataset.get(), values.type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.bytes.data());
    }
    return;
  }
  dataset.reset();
  if (verb == "type") {
    put_back(file, path, values, type_of(first), 0);
  } else if (verb == "chunked") {
    put_back(file, path, values, values.type.get(), std::max<hsize_t>(1, number));
  } else if (verb == "rows" && !values.shape.empty()) {
    values.shape[0] = number % (kMostItems / 8);
    if (values.count() <= kMostItems) {
      values.bytes.resize(values.count() * values.item());
      put_back(file, path, values, values.type.get(), 0);
    }
  } else if (verb == "rank") {
    const hsize_t count = values.count();
    values.shape.assign(number % 5, 1);
    if (!values.shape.empty()) {
      values.shape[0] = count;
    }
    values.bytes.resize(values.count() * values.item());
    put_back(file, path, values, values.type.get(), 0);
  }
}

void edit_attribute(hid_t file, const std::string& verb, const std::string& path, std::istream& rest) {
  const Handle object(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose);
  std::string name;
  std::string value;
  rest >> name >> std::ws;
  std::getline(rest, value);
  if (!object.valid() || name.empty()) {
    return;
  }
  H5Adelete(object.get(), name.c_str());
  if (verb == "number") {
    h5::write_number_attribute(object.get(), name, std::strtod(value.c_str(), nullptr));
  } else if (verb == "integer") {
    h5::write_number_attribute(object.get(), name,
                               static_cast<std::int64_t>(std::strtoll(value.c_str(), nullptr, 0)));
  } else if (verb == "text") {
    h5::write_text_attribute(object.get(), name, value);
  }
}

void apply_edit(hid_t file, const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  std::string path;
  words >> verb >> path;
  if (path.empty() || verb.starts_with("#")) {
    return;
  }
  if (verb == "drop") {
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  } else if (verb == "number" || verb == "integer" || verb == "text" || verb == "strip") {
    edit_attribute(file, verb, path, words);
  } else {
    edit_dataset(file, verb, path, words);
  }
}

/// Names of the datasets, and "object name" of the attributes, of a seed.
struct Places {
  std::vector<std::string> datasets, attributes;
};

const Places& places_of(std::string_view seed) {
  static std::map<std::string, Places, std::less<>> known;
  if (const auto found = known.find(seed); found != known.end()) {
    return found->second;
  }
  Places places;
  const Handle file = open_image(seed_bytes(seed));
  const auto visit = [](hid_t root, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    auto& out = *static_cast<Places*>(data);
    if (info->type == H5O_TYPE_DATASET) {
      out.datasets.emplace_back(name);
    }
    const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
    for (int i = 0; i < H5Aget_num_attrs(object.get()); ++i) {
      std::array<char, 64> attribute{};
      H5Aget_name_by_idx(object.get(), ".", H5_INDEX_NAME, H5_ITER_INC, static_cast<hsize_t>(i),
                         attribute.data(), attribute.size(), H5P_DEFAULT);
      out.attributes.push_back((std::string(name) == "." ? "/" : name) + std::string(" ") + attribute.data());
    }
    return 0;
  };
  H5Ovisit(file.get(), H5_INDEX_NAME, H5_ITER_INC, visit, &places);
  if (places.datasets.empty() || places.attributes.empty()) {
    throw std::runtime_error("the seed " + std::string(seed) + " holds nothing");
  }
  return known.emplace(seed, std::move(places)).first->second;
}

template <class Range>
const auto& one_of(const Range& range, std::minstd_rand& draw) {
  return range[draw() % range.size()];
}

std::string some_number(std::minstd_rand& draw) {
  static constexpr std::array kNumbers{"nan",
                                       "inf",
                                       "-inf",
                                       "1e308",
                                       "-1e308",
                                       "1e-320",
                                       "1e18",
                                       "1e9",
                                       "-1e6",
                                       "0",
                                       "-0.0",
                                       "1",
                                       "-1",
                                       "2",
                                       "127",
                                       "255",
                                       "0x7fffffff",
                                       "-0x80000000",
                                       "0xffffffff",
                                       "0x7fffffffffffffff",
                                       "-0x8000000000000000",
                                       "0xffffffffffffffff",
                                       "0x4000000000000000"};
  if (draw() % 2 == 0) {
    return one_of(kNumbers, draw);
  }
  const auto small = static_cast<int>(draw() % 2000) - 1000;
  return draw() % 2 == 0 ? std::to_string(small) : std::to_string(small * 0.01);
}

std::string some_edit(std::string_view seed, std::minstd_rand& draw) {
  const Places& places = places_of(seed);
  const std::string& dataset = one_of(places.datasets, draw);
  static constexpr std::array kTypes{"f32", "f64", "u8", "i8", "u16", "i16", "u32", "i32", "u64", "i64"};
  switch (draw() % 16) {
    case 0:
      return "fill " + dataset + " " + some_number(draw);
    case 1:
      return "rows " + dataset + " " + std::to_string(draw() % 2 == 0 ? draw() % 20 : draw() % 2000);
    case 2:
      return "type " + dataset + " " + one_of(kTypes, draw);
    case 3:
      return "rank " + dataset + " " + std::to_string(draw() % 5);
    case 4:
      return "chunked " + dataset + " " + std::to_string(std::uint64_t{1} << (draw() % 63));
    case 5:
      return "drop " + (draw() % 4 == 0 ? dataset.substr(0, dataset.find('/')) : dataset);
    case 6: {
      static constexpr std::array kVerbs{"number", "integer", "text", "strip"};
      static constexpr std::array kTexts{"",   "1",    "nan",      "9.9",      "1.0",
                                         "{}", "word", "\xff\xfe", "[[[[[[[[", "-1"};
      return std::string(one_of(kVerbs, draw)) + " " + one_of(places.attributes, draw) + " " +
             one_of(kTexts, draw);
    }
    default: {
      static constexpr std::array<unsigned, 6> kEnds{0, 1, 2, 4294967295U, 1000, 100000};
      const auto index = draw() % 2 == 0 ? one_of(kEnds, draw) : static_cast<unsigned>(draw());
      return "set " + dataset + " " + std::to_string(index) + " " + some_number(draw);
    }
  }
}

}  // namespace

std::string edited_artefact(std::string_view seed, std::string_view edits) {
  const Handle file = open_image(seed_bytes(seed));
  if (!file.valid()) {
    throw std::runtime_error("the seed " + std::string(seed) + " is no HDF5 file");
  }
  std::istringstream lines{std::string(edits)};
  for (std::string line; std::getline(lines, line);) {
    apply_edit(file.get(), line);
  }
  return image_of(file);
}

std::string mutated_edits(std::string_view seed, std::string_view edits, std::size_t size_limit,
                          std::minstd_rand& draw) {
  std::vector<std::string> lines;
  std::istringstream text{std::string(edits)};
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line);
  }
  const std::size_t at = lines.empty() ? 0 : draw() % lines.size();
  const auto way = draw() % 4;
  if (lines.empty() || way == 0) {
    lines.push_back(some_edit(seed, draw));
  } else if (way == 1) {
    lines[at] = some_edit(seed, draw);
  } else if (way == 2 && lines.size() > 1) {
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
  } else {  // another number at the end of the line
    lines[at] = lines[at].substr(0, lines[at].rfind(' ') + 1) + some_number(draw);
  }
  std::string out;
  for (const std::string& line : lines) {
    if (out.size() + line.size() + 1 <= size_limit) {
      out += line + "\n";
    }
  }
  return out;
}

}  // namespace roomcut::fuzz
