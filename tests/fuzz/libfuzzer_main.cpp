// SPDX-License-Identifier: GPL-3.0-or-later
// What libFuzzer calls. One program for all targets, so that there is one to link; which one it is says the
// name that it is started by: fuzz_<target>.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/hdf5_edits.h"
#include "tests/fuzz/json_mutator.h"
#include "tests/fuzz/target.h"

using namespace roomcut::fuzz;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {
const Target* target = nullptr;
}

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** argv) {
  const std::string_view program = (*argv)[0];
  const std::size_t name = program.rfind("fuzz_");
  target = name == std::string_view::npos ? nullptr : find_target(program.substr(name + 5));
  if (target == nullptr) {
    std::fprintf(stderr, "start it as fuzz_<target>; the targets are:\n");
    for (const Target& one : targets()) {
      std::fprintf(stderr, "%.*s\n", static_cast<int>(one.name.size()), one.name.data());
    }
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  answer(*target, {reinterpret_cast<const char*>(data), size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  std::minstd_rand draw(seed);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string changed;
  if (target->mutation == Mutation::kHdf5Edits) {
    changed = mutated_edits(target->seed, text, max_size, draw);
  } else if (target->mutation == Mutation::kJson && draw() % 2 == 0) {
    changed = mutated_json(text, max_size, draw);
  }
  if (changed.empty()) {
    return LLVMFuzzerMutate(data, size, max_size);
  }
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
}
