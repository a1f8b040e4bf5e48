#include "floatframe/model_file/parsed_files.hpp"

namespace floatframe {

std::shared_ptr<const YamlDocument> ParsedFiles::get(const std::string& file,
                                                     const std::string& text, ReadErrors& errors) {
  const std::lock_guard lock(mutex_);
  const auto known = files_.find(file);
  if (known != files_.end() && known->second.text == text) return known->second.document;
  const std::size_t before = errors.size();
  auto document = std::make_shared<const YamlDocument>(parse_yaml(file, text, errors));
  if (errors.size() == before) files_.insert_or_assign(file, Parsed{text, document});
  return document;
}

PiecewisePolynomial ParsedFiles::road(const RoadSpectrum& spectrum) {
  constexpr std::size_t kept = 8;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [of, road] : roads_)
      if (of == spectrum) return road;
  }
  PiecewisePolynomial made = random_road(spectrum);
  const std::lock_guard lock(mutex_);
  roads_.emplace_back(spectrum, made);
  if (roads_.size() > kept) roads_.pop_front();
  return made;
}

}  // namespace floatframe
