#include "floatframe/report/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "floatframe/report/html_text.hpp"
#include "floatframe/report/report_style.hpp"
#include "floatframe/report/svg_plot.hpp"

namespace floatframe {
namespace {

std::string number(double value, int digits = 5) {
  if (!std::isfinite(value)) return "not finite";
  std::string text = fmt::format("{:.{}g}", value, digits);
  if (text == "-0") return "0";
  if (text.front() == '-') text.replace(0, 1, "\xE2\x88\x92");
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  // 1.2e-12 -> 1.2 x 10^-12
  const int exponent = std::stoi(text.substr(e + 1));
  const std::string sign = exponent < 0 ? "\xE2\x88\x92" : "";
  return fmt::format(
      "{}\xC2\xB7"
      "10<sup>{}{}</sup>",
      text.substr(0, e), sign, std::abs(exponent));
}

std::string quantity(double value, const std::string& unit) {
  return number(value) + (unit.empty() ? "" : "&nbsp;" + html_escape(unit));
}

void figure(fmt::memory_buffer& page, const ReportCurves& curves, const PlotGroup& group) {
  auto out = std::back_inserter(page);
  fmt::format_to(out, "<figure>\n<figcaption><h3>{}</h3>", html_escape(group.title));
  if (group.columns.size() > 1) {
    fmt::format_to(out, "<ul class=\"legend\">");
    for (std::size_t i = 0; i < group.columns.size(); ++i) {
      fmt::format_to(out, "<li>{}{}</li>", svg_legend_key(i),
                     html_escape(curves.columns[group.columns[i]].name));
    }
    fmt::format_to(out, "</ul>");
  }
  fmt::format_to(out, "</figcaption>\n<div class=\"plot\">{}</div>\n</figure>\n",
                 svg_plot(curves, group));
}

void headline(fmt::memory_buffer& page, const RunSummary& s) {
  auto out = std::back_inserter(page);
  const auto item = [&](const std::string& value, const std::string& label) {
    fmt::format_to(out, "<div><b>{}</b><span>{}</span></div>\n", value, label);
  };
  fmt::format_to(out, "<div class=\"headline\">\n");
  item(quantity(s.duration, "s"), "simulated");
  item(quantity(s.cpu, "s"), "processor time");
  item(s.cpu > 0.0 ? number(s.real_time_factor) : "&ndash;", "times real time");
  item(s.steps > 0
           ? fmt::format("{:.2f}", static_cast<double>(s.iterations) / static_cast<double>(s.steps))
           : "&ndash;",
       "Newton iterations per step");
  fmt::format_to(out, "</div>\n");
}

void fact_table(fmt::memory_buffer& page, const FactTable& table) {
  auto out = std::back_inserter(page);
  fmt::format_to(out, "<section><h2>{}</h2>\n<table class=\"facts\">\n", html_escape(table.title));
  for (const auto& row : table.rows) {
    fmt::format_to(out, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escape(row[0]),
                   html_escape(row[1]));
  }
  fmt::format_to(out, "</table></section>\n");
}

void run_table(fmt::memory_buffer& page, const RunSummary& s) {
  auto out = std::back_inserter(page);
  const auto row = [&](const char* name, const std::string& value) {
    fmt::format_to(out, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, value);
  };
  fmt::format_to(out, "<section><h2>Run</h2>\n<table class=\"facts\">\n");
  row("status", html_escape(s.status));
  row("steps", fmt::format("{}", s.steps));
  row("extra steps by halving", fmt::format("{}", s.substeps));
  if (s.locates_edges) {
    row("edges that steps were divided at", fmt::format("{}", s.edges));
    row("steps with too many edges", fmt::format("{}", s.edges_passed));
  }
  if (s.corners > 0)
    row("corners of functions of time that steps were divided at", fmt::format("{}", s.corners));
  row("Newton iterations", fmt::format("{}", s.iterations));
  row("factorisations", fmt::format("{}", s.factorizations));
  row("largest position violation", quantity(s.max_position_violation, "m"));
  row("largest velocity violation", quantity(s.max_velocity_violation, "m/s"));
  fmt::format_to(out, "</table></section>\n");
}

void warning_list(fmt::memory_buffer& page, const std::vector<RangeWarning>& warnings) {
  if (warnings.empty()) return;
  auto out = std::back_inserter(page);
  fmt::format_to(out, "<div class=\"warned\" role=\"note\"><b>{}</b>\n<ul>\n",
                 warnings.size() == 1 ? "Outside the range of the method"
                                      : "Outside the range of the method, in several ways");
  for (const RangeWarning& w : warnings)
    fmt::format_to(out, "<li>{}</li>\n", html_escape(w.sentence));
  fmt::format_to(out, "</ul></div>\n");
}

void balance_rows(fmt::memory_buffer& page, const EnergySummary& e, bool damped) {
  auto out = std::back_inserter(page);
  const auto row = [&](const std::string& name, double value) {
    fmt::format_to(out, "<tr><th scope=\"row\">{}</th><td></td><td></td><td>{}</td></tr>\n", name,
                   number(value));
  };
  for (std::size_t k = 0; k < EnergyFlows::size(); ++k)
    if (e.work.value[k] != 0.0)
      row("work of " + spaced_words(energy_flow_names[k]), e.work.value[k]);
  row(damped ? "remainder: numerical dissipation" : "remainder: error of the integration",
      e.remainder);
}

void energy_table(fmt::memory_buffer& page, const EnergySummary& e, bool damped) {
  auto out = std::back_inserter(page);
  const auto row = [&](const char* name, double start, double end) {
    fmt::format_to(out, "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                   name, number(start, 7), number(end, 7), number(end - start));
  };
  fmt::format_to(
      out,
      "<section><h2>Energy</h2>\n<div class=\"wide\"><table>\n<tr><th scope=\"col\">energy [J]</th>"
      "<th scope=\"col\">start</th><th scope=\"col\">end</th><th scope=\"col\">change</th></tr>\n");
  row("kinetic", e.kinetic_start, e.kinetic_end);
  row("potential", e.potential_start, e.potential_end);
  row("elastic", e.elastic_start, e.elastic_end);
  row("total", e.total_start, e.total_end);
  if (e.balanced) balance_rows(page, e, damped);
  fmt::format_to(out,
                 "</table></div>\n<p class=\"note\">The change of the total is the work of loads, "
                 "actuators, dampers, tyres, modal damping and prescribed motions, and a "
                 "remainder.</p></section>\n");
}

void extremes_table(fmt::memory_buffer& page, const ReportCurves& curves) {
  auto out = std::back_inserter(page);
  fmt::format_to(out,
                 "<section><h2>Extreme values</h2>\n<div class=\"wide\"><table>\n<tr><th "
                 "scope=\"col\">output</th>"
                 "<th scope=\"col\">smallest</th><th scope=\"col\">at time [s]</th><th "
                 "scope=\"col\">largest</th>"
                 "<th scope=\"col\">at time [s]</th><th scope=\"col\">at the end</th></tr>\n");
  for (std::size_t c = 1; c < curves.columns.size(); ++c) {
    const Column& column = curves.columns[c];
    const ColumnExtremes& e = curves.extremes[c];
    fmt::format_to(
        out,
        "<tr><th "
        "scope=\"row\">{}{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        html_escape(column.name), column.unit.empty() ? "" : " [" + html_escape(column.unit) + "]",
        number(e.smallest.value), number(e.smallest.time), number(e.largest.value),
        number(e.largest.time), number(e.last.value));
  }
  fmt::format_to(out, "</table></div></section>\n");
}

/// That the results are not those of a whole run that went well.
void banner(fmt::memory_buffer& page, const Report& report) {
  const RunSummary& s = report.result.summary;
  if (s.status == "completed") return;
  auto out = std::back_inserter(page);
  if (s.strict) {
    fmt::format_to(
        out, "<div class=\"failed\" role=\"alert\"><b>This run counts as failed.</b> {}</div>\n",
        html_escape(s.message));
  } else {
    fmt::format_to(
        out,
        "<div class=\"failed\" role=\"alert\"><b>This run {}: the results are partial.</b> "
        "They end at {}.<br>{}</div>\n",
        s.status == "interrupted" ? "was interrupted" : "failed",
        quantity(report.rows_end.value_or(s.duration), "s"), html_escape(s.message));
  }
}

/// What the start of the run has to say, at the top.
void notes(fmt::memory_buffer& page, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return;
  auto out = std::back_inserter(page);
  fmt::format_to(out, "<section><h2>Notes on the start</h2>\n<ul>\n");
  for (const std::string& sentence : sentences)
    fmt::format_to(out, "<li>{}</li>\n", html_escape(sentence));
  fmt::format_to(out, "</ul></section>\n");
}

}  // namespace

std::string report_html(const Report& report) {
  const RunSummary& s = report.result.summary;
  const ReportCurves curves = report.curves ? *report.curves : report_curves(report.result.table);
  const bool has_curves = curves.rows > 0 && curves.columns.size() > 1;
  fmt::memory_buffer page;
  auto out = std::back_inserter(page);
  fmt::format_to(out,
                 "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                 "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{0} - Floatframe "
                 "report</title>\n"
                 "<style>\n{1}</style>\n</head>\n<body>\n<main>\n<header>\n<p "
                 "class=\"kind\">Floatframe report</p>\n"
                 "<h1>{0}</h1>\n<p class=\"kind\">{2} coordinates, inertia terms by {3}, step "
                 "{4}</p>\n</header>\n",
                 html_escape(s.model), report_style, html_escape(s.coordinates),
                 html_escape(s.inertia), quantity(s.step, "s"));
  banner(page, report);
  warning_list(page, s.warnings);
  headline(page, s);
  notes(page, s.start.notes);
  if (has_curves) {
    fmt::format_to(out, "<h2>Curves</h2>\n");
    for (const PlotGroup& group : group_columns(curves.columns)) figure(page, curves, group);
    extremes_table(page, curves);
  }
  fmt::format_to(out, "<div class=\"pair\">\n");
  run_table(page, s);
  energy_table(page, s.energy, report.spectral_radius < 1.0);
  for (const FactTable& facts : report.facts) fact_table(page, facts);
  fmt::format_to(
      out,
      "</div>\n<footer>Floatframe {}<br>{}<br>SI units, angles in radians.</footer>\n</main>\n",
      html_escape(report.software), html_escape(report.processor));
  fmt::format_to(out, "</body>\n</html>\n");
  return fmt::to_string(page);
}

}  // namespace floatframe
