#include "floatframe/fmu/fmu_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/build_info.hpp"
#include "floatframe/page/html_text.hpp"

namespace floatframe {
namespace {

constexpr std::string_view page_style =
    "body{font:15px/1.5 system-ui,sans-serif;color:#1d232b;max-width:62rem;margin:2rem auto;"
    "padding:0 1rem}h1{font-size:1.6rem}h2{font-size:1.15rem;margin-top:2rem}"
    "table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.2rem .8rem .2rem 0;"
    "border-bottom:1px solid #dde2e8;vertical-align:top}th{font-weight:600}"
    "code{font:13px ui-monospace,monospace}td.n{text-align:right;white-space:nowrap}";

std::string number_text(const std::optional<double>& x) {
  return x ? fmt::format("{}", *x) : std::string();
}

using PageRow = std::vector<std::string>;

/// Cells are HTML.
std::string html_table(const PageRow& titles, const std::vector<PageRow>& rows) {
  std::string out = "<table>\n";
  if (!titles.empty()) {
    out += "<tr>";
    for (const std::string& t : titles) out += "<th>" + html_escape(t) + "</th>";
    out += "</tr>\n";
  }
  for (const PageRow& row : rows) {
    out += "<tr>";
    for (const std::string& cell : row) out += "<td>" + cell + "</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string code_html(const std::string& text) { return "<code>" + html_escape(text) + "</code>"; }

std::string variables_html(const std::string& title, const std::string& about,
                           const std::vector<FmuVariable>& list) {
  if (list.empty()) return "";
  const auto any = [&](auto has) { return std::any_of(list.begin(), list.end(), has); };
  const bool starts = any([](const FmuVariable& v) { return v.start.has_value(); });
  const bool limits = any([](const FmuVariable& v) { return v.low || v.high; });
  PageRow titles{"name", "unit"};
  if (starts) titles.push_back("start");
  if (limits) titles.insert(titles.end(), {"min", "max"});
  titles.insert(titles.end(), {"value reference", "what it is"});
  std::vector<PageRow> rows;
  for (const FmuVariable& v : list) {
    PageRow row{code_html(v.name), html_escape(v.unit)};
    if (starts) row.push_back(number_text(v.start));
    if (limits) row.insert(row.end(), {number_text(v.low), number_text(v.high)});
    const std::string what = v.fixed ? "to be set before the end of initialisation" +
                                           std::string(v.about.empty() ? "" : "; ") + v.about
                                     : v.about;
    row.insert(row.end(), {fmt::format("{}", v.reference), html_escape(what)});
    rows.push_back(std::move(row));
  }
  return fmt::format("<h2>{} ({})</h2>\n<p>{}</p>\n", title, list.size(), about) +
         html_table(titles, rows);
}

std::string notes_html(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string out = "<h2>Notes of the export</h2>\n<ul>\n";
  for (const std::string& note : notes) out += "<li>" + html_escape(note) + "</li>\n";
  return out + "</ul>\n";
}

std::string use_html(const FmuContent& content, int version) {
  std::string out = fmt::format(
      "<h2>How to use it</h2>\n<p>An FMU for co-simulation of FMI {}.0: it brings its own "
      "integrator, which makes steps of {} s. A communication step may have any length. If it is "
      "a multiple of the inner step, results are those of <code>floatframe run</code> to the bit; "
      "else the last ones are shortened. An input acts from the next step on, so that "
      "no output depends on an input within an instant.</p>\n",
      version, content.step);
  if (!content.parameters.empty())
    out +=
        "<p>Parameters may be set before the end of initialisation: the start is found with them. "
        "Set later they act from the next step.</p>\n";
  out +=
      "<p>The whole state can be kept, restored and serialised: the steps after it are equal to "
      "the bit. Messages come in the categories <code>logStatusError</code>, "
      "<code>logStatusWarning</code>, <code>logStart</code> and <code>logOverrun</code>.</p>\n";
  if (version == 3)
    out +=
        "<p>Intermediate update is called after each inner step; outputs may be read there, and a "
        "communication step may be ended early.</p>\n";
  return out;
}

constexpr std::string_view licence_html =
    "<h2>Licences</h2>\n<p>The binaries are the runtime of Floatframe (BSD-3-Clause). Compiled "
    "into it are Eigen (MPL-2.0, source: <code>https://gitlab.com/libeigen/eigen</code>), fmt "
    "(MIT) "
    "and the runtime libraries of GCC (GPL-3.0 with the GCC Runtime Library Exception); for "
    "Windows also parts of MinGW-w64 (ZPL-2.1, MIT). The texts are in "
    "<code>documentation/licenses/license.txt</code>. The model belongs to its "
    "exporter.</p>\n";

}  // namespace

std::string fmu_page(const FmuContent& content, int version, const std::vector<std::string>& notes,
                     const std::vector<std::string>& platforms) {
  const std::string title = html_escape(content.model);
  std::string out = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"generator\" content=\"Floatframe {}\">\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body>\n<h1>{}</h1>\n<p>A flexible multibody model, written by Floatframe "
      "{}.</p>\n",
      floatframe::version(), title, page_style, title, floatframe::version());
  std::vector<PageRow> facts;
  for (const auto& [name, value] : content.facts)
    facts.push_back({html_escape(name), html_escape(value)});
  std::string names;
  for (const std::string& p : platforms) names += (names.empty() ? "" : ", ") + p;
  facts.push_back({"platforms", html_escape(names)});
  facts.push_back({"fingerprint", code_html(content.token)});
  out += "<h2>Model</h2>\n" + html_table({}, facts);
  out += use_html(content, version);
  out += variables_html("Inputs",
                        "Values outside of min and max are discarded, if nothing else is "
                        "said; the last value stays.",
                        content.inputs);
  out += variables_html("Outputs", "Of the last instant that was reached.", content.outputs);
  out += variables_html(
      "Parameters",
      "Those that take a new value without a build of the model. Where nothing else is said "
      "a value may change between steps, too.",
      content.parameters);
  out += variables_html("Figures of the run", "For supervision; no output depends on them.",
                        content.figures);
  std::vector<std::string> all = content.notes;
  all.insert(all.end(), notes.begin(), notes.end());
  out += notes_html(all);
  out += licence_html;
  return out + "</body>\n</html>\n";
}

}  // namespace floatframe
