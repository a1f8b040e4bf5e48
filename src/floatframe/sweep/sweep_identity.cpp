#include "floatframe/sweep/sweep_identity.hpp"

#include <tuple>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/library_path.hpp"
#include "floatframe/core/regular_file.hpp"

namespace floatframe {
namespace {

std::string plan_hash(const SweepPlan& plan) {
  ContentHash hash;
  for (const std::string& name : plan.names) hash.add(name);
  for (const auto& run : plan.runs)
    for (const std::string& value : run) hash.add(value);
  return hash.text();
}

}  // namespace

std::string study_hash(const SweepOptions& o, const std::string& first_run) {
  ContentHash hash;
  hash.add(program_identity())
      .add(plan_hash(o.plan))
      .add(static_cast<std::uint64_t>(o.keep_results))
      .add(static_cast<std::uint64_t>(o.strict));
  for (const SweepSetting& s : o.fixed) hash.add(s.name).add(s.value);
  for (const SweepMeasure& m : o.measures) hash.add(m.output).add(m.statistic);
  return hash.add(first_run).text();
}

SweepIdentity identity_of(const SweepOptions& o) {
  SweepIdentity identity{{"made by another build of the program", program_identity()}};
  std::string fixed, measures;
  for (const SweepSetting& s : o.fixed) fixed += s.name + '=' + s.value + '\n';
  for (const SweepMeasure& m : o.measures) measures += m.output + ':' + m.statistic + '\n';
  identity.emplace_back("the varied parameters or their values differ", plan_hash(o.plan));
  identity.emplace_back("the values that are the same for all runs differ", fixed);
  identity.emplace_back("the outputs measured differ", measures);
  identity.emplace_back("one keeps the results of its runs, the other does not",
                        o.keep_results ? "yes" : "no");
  identity.emplace_back("warnings count as errors in one, in the other not",
                        o.strict ? "yes" : "no");
  return identity;
}

std::string program_identity() {
  static const std::string identity = [] {
    std::string content;
    std::ignore = read_regular_file(library_path(), largest_file_read, content);
    return build_description() + ", " + content_hash(content);
  }();
  return identity;
}

}  // namespace floatframe
