// floatframe compare: differences of two results.

#include <memory>

#include "floatframe/apps/commands.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/page/check_page.hpp"
#include "floatframe/page/comparison_report.hpp"

namespace floatframe {
namespace {

struct CompareArguments {
  std::string a, b, tolerance, absolute, report;
  std::vector<std::string> channels;
  bool overlap = false, json = false, overwrite = false;
};

std::optional<ComparisonTolerance> tolerance_of(const CompareArguments& a) {
  if (a.tolerance.empty() && a.absolute.empty()) return std::nullopt;
  ComparisonTolerance t;
  if (!a.tolerance.empty())
    t.relative = option_number("--tolerance", a.tolerance, non_negative_number(""));
  if (!a.absolute.empty())
    t.absolute = option_number("--absolute", a.absolute, non_negative_number(""));
  return t;
}

/// Second reading, for the rows found by the first.
std::string report_of(const ComparedResults& results, const ResultsReader& a,
                      const ResultsReader& b) {
  ResultsReader first(a.file()), second(b.file());
  return comparison_page(results, page_curves(first, a.rows()), page_curves(second, b.rows()),
                         build_description());
}

int compare(const CompareArguments& a) {
  if (!a.report.empty()) require_page("--report");
  ComparedResults results;
  results.file_a = results_file(a.a);
  results.file_b = results_file(a.b);
  results.tolerance = tolerance_of(a);
  results.overlap = a.overlap;
  require_writable({{"--report", a.report}}, {results.file_a, results.file_b}, a.overwrite);
  ResultsReader first(results.file_a), second(results.file_b);
  results.comparison = compare_results(first, second, a.channels);
  if (!a.report.empty()) write_file(a.report, report_of(results, first, second));
  print(a.json ? comparison_json(results) : comparison_text(results));
  const std::vector<std::string> sentences = disagreements(results);
  for (const std::string& sentence : sentences) say(sentence);
  return sentences.empty() ? exit_code::done : exit_code::failed;
}

}  // namespace

Command compare_command() {
  const auto a = std::make_shared<CompareArguments>();
  return {
      .name = "compare",
      .help = "Show how far the results of two runs are apart, channel by channel",
      .options =
          {file_position("A", a->a, "results.csv of a run, or the folder that holds it"),
           file_position("B", a->b, "The result to compare with A"),
           text_option("--tolerance", a->tolerance, "NUMBER",
                       "Exit code 1 if a channel differs by more than this part of its largest "
                       "magnitude in A"),
           text_option("--absolute", a->absolute, "NUMBER",
                       "Added to what --tolerance allows, in the unit of each channel"),
           repeated_option("--channel", a->channels, "NAME",
                           "Compare this channel only (repeatable)"),
           flag("--overlap", a->overlap,
                "Compare the span of time that both have; otherwise another span is a difference"),
           flag("--json", a->json, "JSON on standard output"),
           text_option("--report", a->report, "FILE", "Page with both curves in one plot"),
           overwrite_option(a->overwrite)},
      .footer =
          "Compared at the common instants if one result has all instants of the other, else at\n"
          "those of A, with B interpolated linearly. Any file with a header line and a first "
          "column\n"
          "`time` is accepted.\n"
          "Exit codes: 0 within the tolerance or none given, 1 beyond it, 2 bad input.",
      .run = [a] { return compare(*a); }};
}

}  // namespace floatframe
