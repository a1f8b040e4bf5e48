#include "floatframe/apps/part_arguments.hpp"

#include <algorithm>

#include "floatframe/apps/command.hpp"

namespace floatframe {
namespace {

using O = PartOption;

/// Sets the job's value from an option's text.
struct Parsed {
  PartJob& job;
  const std::string option;
  const std::string& text;

  void operator()(const O::Number& o) const {
    job.options.*o.at = option_number(option, text, o.rule);
  }
  void operator()(const O::Count& o) const {
    job.options.*o.at = whole_option_number(option, text, o.rule);
  }
  void operator()(const O::Word& o) const {  // the parser has rejected other words
    const auto word = std::find(o.words.begin(), o.words.end(), text);
    o.set(job, o.first + static_cast<int>(word - o.words.begin()));
  }
  void operator()(const O::Switch& o) const { job.options.*o.at = o.flag; }
  void operator()(const O::File& o) const { job.read.*o.at = text; }
  void operator()(const O::Special& o) const { o.parse(job, text); }
};

bool is_repeated(const PartOption& option) {
  const auto* special = std::get_if<O::Special>(&option.kind);
  return special && special->repeated;
}

}  // namespace

PartArguments::PartArguments() {
  for (const PartOption& option : part_options()) given_.push_back({&option, {}, {}});
}

std::vector<Option> PartArguments::table(bool reading) {
  std::vector<Option> out;
  for (Given& g : given_) {
    const PartOption& o = *g.option;
    if (reading && !o.reading) continue;
    const std::string name = std::string("--") + o.name;
    if (const auto* word = std::get_if<O::Word>(&o.kind))
      out.push_back(word_option(name, g.text, {word->words.begin(), word->words.end()}, o.help));
    else if (std::holds_alternative<O::Switch>(o.kind))
      out.push_back(flag(name, g.flag, o.help));
    else if (is_repeated(o))
      out.push_back(repeated_option(name, g.texts, o.value, o.help));
    else
      out.push_back(text_option(name, g.text, o.value, o.help));
  }
  return out;
}

PartJob PartArguments::job() const {
  PartJob job;
  for (const Given& g : given_) {
    std::vector<std::string> values = g.texts;
    if (g.flag || !g.text.empty()) values.push_back(g.text);
    for (const std::string& value : values)
      std::visit(Parsed{job, std::string("--") + g.option->name, value}, g.option->kind);
  }
  return job;
}

}  // namespace floatframe
