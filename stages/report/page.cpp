// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/page.h"

#include "common/picture/svg.h"

namespace roomcut {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1150px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #bbb;padding:.2em "
    ".7em;text-align:left}"
    "td{font-variant-numeric:tabular-nums}figure{margin:1.5em "
    "0}img,svg{max-width:100%;height:auto;border:1px solid #ddd}"
    "figcaption{color:#555}@media print{figure{break-inside:avoid}}";

std::string table_html(const ReportTable& table) {
  std::string html = "<h2>" + escaped(table.title) + "</h2>\n<table>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string cell = r == 0 ? "th" : "td";
    html += "<tr>";
    for (const std::string& value : table.rows[r]) {
      html += "<" + cell + ">" + escaped(value) + "</" + cell + ">";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string figure_html(const Picture& picture) {
  std::string html = "<figure>\n";
  if (picture.file.ends_with(".svg")) {
    html += picture.bytes;
  } else {
    html += "<img alt=\"" + escaped(picture.title) + "\" src=\"data:image/png;base64," +
            base64({reinterpret_cast<const std::uint8_t*>(picture.bytes.data()), picture.bytes.size()}) +
            "\">\n";
  }
  return html + "<figcaption><b>" + escaped(picture.title) + "</b> (" + escaped(picture.stage) + "). " +
         escaped(picture.caption) + "</figcaption>\n</figure>\n";
}

}  // namespace

std::string make_page(const std::string& name, const std::vector<ReportTable>& tables,
                      const std::vector<Picture>& pictures) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     escaped(name) + "</title><style>" + kStyle + "</style></head><body>\n<h1>" +
                     escaped(name) + "</h1>\n";
  for (const ReportTable& table : tables) {
    html += table_html(table);
  }
  html += "<h2>Every stage</h2>\n";
  for (const Picture& picture : pictures) {
    html += figure_html(picture);
  }
  return html + "</body></html>\n";
}

}  // namespace roomcut
