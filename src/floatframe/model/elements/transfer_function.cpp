// y = (b_0 s^n + ... + b_n) / (a_0 s^n + ... + a_n) u, with p = s / w in place of s, so that the
// coefficients a_k / w^k have similar sizes: w is the geometric mean of the poles other than 0.
//   zdot_i = w (z_{i+1} - a_{i+1} / (a_0 w^{i+1}) z_0) + c_{i+1} / w^i u,  y = z_0 + d u        (1)
//   d = b_0 / a_0,  c_k = b_k / a_0 - d a_k / a_0
// Sampled it is of z in place of s, and z_i are the next ones in place of their rates.
// A pole at 0 is the last equation of (1) without states: statics know it as an integral. States of
// poles that are far apart are balanced.
#include <cmath>

#include "floatframe/description/sentences.hpp"
#include "floatframe/math/balancing.hpp"
#include "floatframe/model/linear_block.hpp"

namespace floatframe {

namespace {

constexpr Eigen::Index most_coefficients = 101;

/// Geometric mean of the poles other than 0; a(0) = 1.
double mean_pole(const VecX& a) {
  for (Eigen::Index k = a.size() - 1; k > 0; --k)
    if (a[k] != 0.0) return std::pow(std::abs(a[k]), 1.0 / k);
  return 1.0;
}

LinearBlock realised(const TransferFunction& keys) {
  const Eigen::Index n = keys.denominator.size() - 1;
  const double leading = keys.denominator(0);
  const VecX a = keys.denominator.reshaped() / leading;
  VecX b = VecX::Zero(n + 1);
  const Eigen::Index given = std::min(n + 1, keys.numerator.size());  // zeros may be before them
  b.tail(given) = keys.numerator.reshaped().tail(given) / leading;
  LinearBlock out{MatX::Zero(n, n), MatX(n, 1), MatX::Zero(1, n), MatX::Constant(1, 1, b[0]), {}};
  const double w = mean_pole(a);
  for (Eigen::Index i = 0; i < n; ++i) {  // (1)
    const double power = std::pow(w, i);
    out.A(i, 0) = -a[i + 1] / power;
    if (i + 1 < n) out.A(i, i + 1) = w;
    out.B(i) = (b[i + 1] - b[0] * a[i + 1]) / power;
  }
  out.C(0) = 1.0;
  const VecX d = balance(out.A);
  out.B.col(0).array() /= d.array();
  out.C.row(0).array() *= d.transpose().array();
  return out;
}

template <class S>
void transfer_function_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  linear_block_law(in, out);
}

}  // namespace

FLOATFRAME_LAW(transfer_function)

namespace {

constexpr ElementKey coefficients_key(const char* name, const char* about, KeyMember member) {
  return {
      .name = name, .kind = KeyKind::matrix, .about = about, .required = true, .member = member};
}
constexpr auto transfer_function_keys = with_sampling<TransferFunction>(
    {input_key(described_by<&TransferFunction::input>),
     coefficients_key("numerator", "coefficients of descending powers of s",
                      described_by<&TransferFunction::numerator>),
     coefficients_key("denominator", "the same; the first one is not 0",
                      described_by<&TransferFunction::denominator>),
     block_start_key(described_by<&TransferFunction::initial>)});

void transfer_function_validate(const ElementCheck& check) {
  validate_sampling(check);
  const MatX a = check.matrix("denominator"), b = check.matrix("numerator");
  for (const auto& [key, x] : {std::pair("numerator", &b), std::pair("denominator", &a)})
    if (check.good(key) && x->size() > 0 && (x->rows() > 1 || x->cols() > most_coefficients))
      return check.error(ErrorCode::wrong_count, key,
                         sentences::coefficients(x->rows(), x->cols(), most_coefficients));
  if (!check.good("denominator") || a.size() == 0) return;
  if (a.size() < 2 || a(0) == 0.0 || !(a / a(0)).allFinite() ||
      (check.good("numerator") && !(b / a(0)).allFinite()))
    return check.error(ErrorCode::out_of_range, "denominator", sentences::leading_coefficient());
  for (Eigen::Index i = 0; check.good("numerator") && i < b.size() - a.size(); ++i)
    if (b(i) != 0.0)
      return check.error(ErrorCode::out_of_range, "numerator",
                         sentences::improper(b.size() - 1 - i, a.size() - 1));
}

ElementExample transfer_function_example(std::size_t regime, ExampleNumbers& numbers) {
  ElementExample x;
  TransferFunction f;
  f.input = x.linked_signal(numbers);
  f.denominator = MatX(1, 4);
  f.numerator = MatX(1, 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    f.denominator(i) = numbers(1.0, 3.0);
    f.numerator(i) = numbers(-3.0, 3.0);
  }
  if (regime == 1) f.period = 0.1;
  return block_example(std::move(x), std::move(f), numbers);
}

}  // namespace

constinit const ElementKind transfer_function_element = [] {
  auto kind = block_kind<TransferFunction>(
      "a rational function of s, numerator over denominator, times its input",
      transfer_function_keys);
  kind.validate = transfer_function_validate;
  kind.states = [](Element& element) {
    const auto& keys = *std::get_if<TransferFunction>(element.keys.get());
    take_linear_block(element, realised(keys), keys.initial, keys);
  };
  kind.start = start_linear_block;
  kind.sample = sample_linear_block;
  kind.dual = transfer_function_law<Dual>;
  kind.regimes = sampled_regimes;
  return kind;
}();

constinit const ExampleMaker transfer_function_examples = transfer_function_example;

}  // namespace floatframe
