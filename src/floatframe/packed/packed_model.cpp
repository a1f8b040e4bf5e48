// The file: a head of 40 bytes - the magic, format and layout, a checksum of all other bytes - and
// three sections, each behind its length: the description; name and hints; parameters.
#include "floatframe/packed/packed_model.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "floatframe/core/regular_file.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/build_stages.hpp"
#include "floatframe/packed/pass_formula.hpp"

namespace floatframe {
// Found by their arguments, as all that is passed.
template <class S>
void pass(S& s, PackedParameter& p) {
  auto& [name, unit, about, value] = p;
  all(s, name, unit, about, value);
}
template <class S>
void pass(S& s, PackedExpression& e) {
  auto& [formula, offset, factor] = e;
  formula = std::uint32_t(s.whole(formula));
  offset = std::uint32_t(s.whole(offset));
  pass(s, factor);
}
template <class S>
void pass(S& s, BarBending& b) {
  auto& [body, bars, stiffness, direction] = b;
  all(s, body, bars, stiffness, direction);
}
/// Without loops that are locked: they are found when the model is built.
template <class S>
void pass(S& s, ModelHints& h) {
  all(s, h.notes, h.bending);
}

namespace {

constexpr std::string_view magic = "floatframe-model";
/// Raised with every change of what the bytes mean.
constexpr std::uint64_t format = 2;
constexpr std::size_t format_at = 16, layout_at = 24, checksum_at = 32, head = 40;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 32;

std::uint64_t word_at(std::span<const std::byte> bytes, std::size_t at) noexcept {
  std::uint64_t n = 0;
  const std::size_t count = std::min<std::size_t>(8, bytes.size() - at);
  for (std::size_t k = 0; k < count; ++k)
    n |= std::to_integer<std::uint64_t>(bytes[at + k]) << (8 * k);
  return n;
}
void put_word(std::span<std::byte> bytes, std::size_t at, std::uint64_t n) noexcept {
  for (std::size_t k = 0; k < 8; ++k) bytes[at + k] = std::byte(n >> (8 * k));
}

/// FNV-1a over words of eight bytes, without the checksum itself: any change of one word differs.
std::uint64_t checksum(std::span<const std::byte> bytes) noexcept {
  constexpr std::uint64_t prime = 0x100000001b3u;
  std::uint64_t h = 0xcbf29ce484222325u ^ bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    if (at == checksum_at) continue;
    h = (h ^ word_at(bytes, at)) * prime;
    h ^= h >> 32;
  }
  return h;
}

std::string hexadecimal(std::uint64_t n) {
  std::string out;
  for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[(n >> shift) & 15u];
  return out;
}

void append(std::vector<std::byte>& bytes, const std::vector<std::byte>& section) {
  bytes.resize(bytes.size() + 8);
  put_word(bytes, bytes.size() - 8, section.size());
  bytes.insert(bytes.end(), section.begin(), section.end());
}

std::span<const std::byte> take_section(std::span<const std::byte>& left) {
  ByteReader::require(left.size() >= 8, "it ends too early");
  const std::uint64_t n = word_at(left, 0);
  ByteReader::require(n <= left.size() - 8, "it ends too early");
  const auto section = left.subspan(8, n);
  left = left.subspan(8 + n);
  return section;
}

void check_head(std::span<const std::byte> bytes) {
  if (!is_packed_model(bytes))
    throw InputError(ErrorCode::wrong_file,
                     "found something else than a packed model, expected a file of 'floatframe "
                     "pack'");
  ByteReader::require(bytes.size() >= head, "it ends too early");
  if (const std::uint64_t found = word_at(bytes, format_at); found != format)
    throw InputError(ErrorCode::mismatch, "found a packed model of format " +
                                              std::to_string(found) + ", expected format " +
                                              std::to_string(format) +
                                              ": pack the model again with this version");
  ByteReader::require(word_at(bytes, checksum_at) == checksum(bytes), "its checksum differs");
  if (word_at(bytes, layout_at) != description_layout())
    throw InputError(ErrorCode::mismatch,
                     "found a packed model of another version of Floatframe, expected one of this "
                     "version: pack the model again");
}

}  // namespace

bool is_packed_model(std::span<const std::byte> bytes) noexcept {
  if (bytes.size() < magic.size()) return false;
  return std::ranges::equal(magic, bytes.first(magic.size()),
                            [](char a, std::byte b) { return std::byte(a) == b; });
}

void seal_packed_model(std::span<std::byte> bytes) noexcept {
  if (bytes.size() >= head) put_word(bytes, checksum_at, checksum(bytes));
}

PackedModel::PackedModel(const ModelDescription& description, ModelHints hints)
    : content_(description_bytes(description)), name_(description.name), hints_(std::move(hints)) {
  hints_.locked.clear();
}

PackedModel PackedModel::from_bytes(std::span<const std::byte> bytes) {
  check_head(bytes);
  std::span<const std::byte> left = bytes.subspan(head);
  PackedModel out;
  const auto content = take_section(left), notes = take_section(left), tuned = take_section(left);
  ByteReader::require(left.empty(), "it goes on behind its end");
  out.content_.bytes.assign(content.begin(), content.end());
  ByteReader n(notes);
  all(n, out.name_, out.hints_);
  ByteReader t(tuned);
  std::vector<PackedParameter> parameters;
  std::vector<SharedFormula> formulas;
  std::vector<PackedExpression> expressions;
  all(t, parameters, formulas, expressions);
  ByteReader::require(n.at_end() && t.at_end(), "it goes on behind its end");
  out.tune(std::move(parameters), std::move(formulas), std::move(expressions));
  return out;
}

std::vector<std::byte> PackedModel::to_bytes() const {
  std::vector<std::byte> bytes(head);
  std::ranges::transform(magic, bytes.begin(), [](char c) { return std::byte(c); });
  put_word(bytes, format_at, format);
  put_word(bytes, layout_at, description_layout());
  append(bytes, content_.bytes);
  PackedModel copy = *this;  // a writer changes nothing, but takes what it may change
  ByteWriter notes, tuned;
  all(notes, copy.name_, copy.hints_);
  all(tuned, copy.parameters_, copy.formulas_, copy.expressions_);
  append(bytes, notes.bytes);
  append(bytes, tuned.bytes);
  seal_packed_model(bytes);
  return bytes;
}

std::string PackedModel::fingerprint() const {
  return hexadecimal(word_at(to_bytes(), checksum_at));
}

int PackedModel::find_parameter(std::string_view name) const noexcept {
  const auto it = std::ranges::find(parameters_, name, &PackedParameter::name);
  return it == parameters_.end() ? -1 : int(it - parameters_.begin());
}

void PackedModel::tune(std::vector<PackedParameter> parameters, std::vector<SharedFormula> formulas,
                       std::vector<PackedExpression> expressions) {
  std::set<std::string_view> names;
  for (const PackedParameter& p : parameters)
    if (!names.insert(p.name).second)
      throw InputError(ErrorCode::duplicate,
                       "found the parameter '" + p.name + "' twice, expected each once");
  for (const SharedFormula& f : formulas) {
    ByteReader::require(f != nullptr, "a formula that is missing");
    for (const FormulaReference& r : f->references)
      if (!r.function.empty() || !names.contains(r.name))
        throw InputError(ErrorCode::not_found, "found '" + r.name + "' in the formula '" + f->text +
                                                   "', expected the name of a parameter");
  }
  for (const PackedExpression& e : expressions)
    ByteReader::require(
        e.formula < formulas.size() && e.offset + std::uint64_t{8} <= content_.bytes.size(),
        "a number that does not exist");
  parameters_ = std::move(parameters);
  formulas_ = std::move(formulas);
  expressions_ = std::move(expressions);
}

std::vector<std::byte> PackedModel::with_values(std::span<const double> values) const {
  if (values.size() != parameters_.size())
    throw InputError(ErrorCode::wrong_count, "found " + std::to_string(values.size()) +
                                                 " values of parameters, expected " +
                                                 std::to_string(parameters_.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw InputError(ErrorCode::not_finite, "found a value of the parameter '" +
                                                  parameters_[k].name +
                                                  "' that is not finite, expected a number");
  std::vector<double> results;
  for (const SharedFormula& f : formulas_) {
    std::vector<double> given;
    for (const FormulaReference& r : f->references) given.push_back(values[find_parameter(r.name)]);
    FormulaSwitches switches;
    FormulaFault fault;
    results.push_back(evaluate_formula<double>(
        *f, [&](int k) { return given[k]; }, switches, fault));
    if (fault.kind != FormulaFault::Kind::none)
      throw InputError(ErrorCode::out_of_range,
                       "found " + fault_text(*f, fault) + ", expected a number of the parameters");
  }
  std::vector<std::byte> bytes = content_.bytes;
  for (const PackedExpression& e : expressions_)
    put_word(bytes, e.offset, std::bit_cast<std::uint64_t>(e.factor * results[e.formula]));
  return bytes;
}

ModelDescription PackedModel::description(std::span<const double> values) const {
  ModelDescription d = description_of(values.empty() ? content_.bytes : with_values(values));
  d.hints = std::make_shared<const ModelHints>(hints_);
  return d;
}

Model PackedModel::build(std::span<const double> values) const {
  return build_model(
      description(values),
      [](const BodyDescription&, bool, ErrorList&) -> std::shared_ptr<const FlexibleBody> {
        ByteReader::damaged("a body that is not reduced");
      },
      [](const ModelDescription&, const Model&) { return ModelHints(); });
}

PackedModel read_packed_model(const std::string& path) {
  const std::string text = regular_file(path, most_bytes);
  try {
    return PackedModel::from_bytes(std::as_bytes(std::span(text)));
  } catch (const InputError& error) {
    std::vector<ErrorEntry> entries = error.errors();
    for (ErrorEntry& entry : entries)
      if (entry.mark.file.empty()) entry.mark.file = path;
    throw InputError(std::move(entries));
  }
}

}  // namespace floatframe
