// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/artefact/provenance.h"
#include "common/artefact/types.h"

namespace roomcut {

/// The hint of every damaged artefact.
inline constexpr const char* kMakeAgain =
    "`make run` makes it again; by hand: delete the file and rerun the stage that writes it";

/// What is said of a content that has another digest.
inline constexpr const char* kNotAsWritten =
    "its content does not have the digest that it states: it was damaged or changed after it was written";

/// Throws kArtefactDamaged for the file and, unless `place` is empty, what in it: a dataset, a member.
[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& place,
                                const std::string& what);

/// Throws kArtefactMissing: the system refuses to open or read the file, for the reason `error` (an errno).
[[noreturn]] void throw_unreadable(const std::filesystem::path& path, int error);

/// Whether a digest or checksum that a file states counts. Not in the fuzz build (libFuzzer's own name for
/// it), whose changed files must get to the checks behind it (tests/fuzz/README.md).
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr bool kDigestsCount = false;
#else
inline constexpr bool kDigestsCount = true;
#endif

/// Throws kArtefactDamaged unless the payload digest of what the file holds is the one that it states.
void require_payload(const std::filesystem::path& path, const std::string& stated, const std::string& actual);

/// Throws kArtefactDamaged when the parameters have another digest than is stated with them, if one is: the
/// payload digest does not cover them.
void require_params(const std::filesystem::path& path, const Provenance& provenance);

/// Throws kArtefactDamaged unless the frame's origin is finite and sane (limits.h).
void require_sane(const std::filesystem::path& path, const Frame& frame);

/// "1.0"
std::string version_text(ArtefactType type);

/// Refuses another type (kArtefactType), another major or a newer minor version (kArtefactVersion), naming
/// both; an empty `artefact` or a version that is not "major.minor" is kArtefactDamaged.
void check_type_and_version(const std::filesystem::path& path, const std::string& artefact,
                            const std::string& version, ArtefactType expected);

/// The payload digest that the file at `path` states; empty when there is no such file or it states none.
std::string stated_payload(const std::filesystem::path& path);

/// The canonical payload digest of a plain JSON artefact's text: all members but `provenance`. "" when it is
/// not JSON.
std::string json_payload_sha256(const std::string& text);

}  // namespace roomcut
