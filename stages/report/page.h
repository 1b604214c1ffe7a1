// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/report/pictures.h"

namespace roomcut {

/// A table of the report: the first row is the head.
struct ReportTable {
  std::string title;
  std::vector<std::vector<std::string>> rows;
};

/// One self-contained HTML document (pictures inside, nothing loaded from anywhere).
std::string make_page(const std::string& name, const std::vector<ReportTable>& tables,
                      const std::vector<Picture>& pictures);

}  // namespace roomcut
