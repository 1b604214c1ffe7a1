// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cloud/cloud.h"

namespace roomcut {

/// Thins a tile in place where it is denser than `most` points per square metre; sparser parts keep every
/// point. Of points that follow each other in one class, one is kept as soon as those since the last one
/// stand for 1/most of surface, and the last of the class; it stands for all of them, so that areas are kept
/// exactly. Order is kept. For what measures coverage, heights or directions: beyond some dozen points per
/// bin more of them tell nothing new.
void thin(CloudTile& tile, double most);

}  // namespace roomcut
