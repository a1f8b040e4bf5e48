// Checks common to all entities: numbers, words, points, functions.
#include <cmath>

#include "floatframe/core/printable.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"

namespace floatframe::validation {

namespace {

std::string indexed(const std::string& key, std::size_t i) {
  return key + "[" + std::to_string(i + 1) + "]";
}

/// For "flexible.material.young" the position of `young`, or of `flexible`, or of the entity.
const SourceMark& mark_of(const Origin& origin, const std::string& key) {
  const std::string path = key.substr(0, key.find('['));
  const std::size_t dot = path.rfind('.');
  if (dot != std::string::npos && origin.keys.contains(path.substr(dot + 1)))
    return origin.of(path.substr(dot + 1));
  return origin.of(path.substr(0, path.find('.')));
}

}  // namespace

void Entity::error(ErrorCode code, const std::string& key, const std::string& sentence) const {
  const std::string at = printable(path + (path.empty() ? "" : ".") + key);
  errors.add({mark_of(origin, key), code, at + ": " + printable(sentence), 1, at});
}

void Entity::error(ErrorCode code, const std::string& sentence) const {
  errors.add({origin.mark, code, printable(path + ": " + sentence), 1, printable(path)});
}

bool Entity::number(const std::string& key, double x, const NumberRule& rule) const {
  const auto complaint = rule.complaint(x);
  complain(ErrorCode::out_of_range, key, complaint);
  return !complaint;
}

bool Entity::whole(const std::string& key, int x, const WholeNumberRule& rule) const {
  const auto complaint = rule.complaint(x);
  complain(ErrorCode::out_of_range, key, complaint);
  return !complaint;
}

bool Entity::vector(const std::string& key, const Vec3& v, const char* unit) const {
  bool good = true;
  for (Eigen::Index i = 0; i < 3; ++i)
    good = number(indexed(key, i), v[i], any_number(unit)) && good;
  return good;
}

bool Entity::list(const std::string& key, const std::vector<double>& v) const {
  bool good = true;
  for (std::size_t i = 0; i < v.size(); ++i)
    good = number(v.size() == 1 ? key : indexed(key, i), v[i], any_number("")) && good;
  return good;
}

bool Entity::direction(const std::string& key, const Vec3& v) const {
  if (!vector(key, v, "")) return false;
  const auto complaint = sentences::direction(v);
  complain(ErrorCode::out_of_range, key, complaint);
  return !complaint;
}

bool Entity::rotation(const std::string& key, const Mat3& R) const {
  if (!R.allFinite()) {
    error(ErrorCode::not_finite, key,
          "found a matrix with numbers that are not finite, expected a rotation matrix");
    return false;
  }
  const double distance = (R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(distance <= 1e-9)) {
    error(ErrorCode::wrong_value, key,
          "found a matrix R with |R^T R - 1| = " + number_text(std::round(distance * 1e12) / 1e12) +
              ", expected a rotation matrix: orthonormal axes");
    return false;
  }
  if (!(R.determinant() > 0.0)) {
    error(ErrorCode::wrong_value, key,
          "found a reflection (determinant -1), expected a rotation matrix: right-handed axes");
    return false;
  }
  return true;
}

bool Entity::reference(const std::string& key, const char* kind, const std::string& name,
                       const NameIndex& known) const {
  if (known.find(name)) return true;
  error(ErrorCode::not_found, key,
        std::string("unknown ") + kind + " '" + name + "'" +
            (errors.size() < most_suggestions ? did_you_mean(name, known.names()) : ""));
  return false;
}

bool Entity::place(const std::string& key, const AttachmentDescription& at, const Names& names,
                   bool ground) const {
  const std::string inside = key.empty() ? "" : key + ".";
  bool good = true;
  if (at.body == ground_name && !ground) {
    error(ErrorCode::wrong_value, inside + "body", sentences::ground_is_no_body());
    good = false;
  } else if (at.body != ground_name) {
    good = reference(inside + "body", "body", at.body, names.bodies);
  } else if (at.node) {
    error(ErrorCode::incomplete, inside + "node", sentences::node_on_ground());
    good = false;
  }
  return vector(inside + "at", at.point, "m") && good;
}

bool Entity::pieces(const std::string& key, const PiecewisePolynomial& f, bool may_jump) const {
  const std::vector<double>& breaks = f.breaks();
  const std::size_t n = f.pieces().size();
  if (n != breaks.size() + 1) {
    error(ErrorCode::wrong_count, key,
          "found " + std::to_string(n) + " pieces and " + std::to_string(breaks.size()) +
              " breaks between them, expected one piece more than breaks");
    return false;
  }
  bool good = true;
  const auto piece = [&](std::size_t k, const char* part) {
    return key + (n == 1 ? std::string() : indexed(".piecewise", k)) + part;
  };
  // Roads have a hundred thousand pieces: names are made of what is wrong alone.
  const auto finite = [&](double x, const auto& name) {
    return std::isfinite(x) || number(name(), x, any_number(""));
  };
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    if (!finite(breaks[k], [&] { return piece(k, ".below"); })) {
      good = false;
    } else if (k > 0 && (may_jump ? breaks[k] < breaks[k - 1] : breaks[k] <= breaks[k - 1])) {
      error(ErrorCode::out_of_range, piece(k, ".below"),
            "found " + number_text(breaks[k]) + ", expected a number above the previous one, " +
                number_text(breaks[k - 1]));
      good = false;
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const PiecewisePolynomial::Piece& p = f.pieces()[k];
    good = finite(p.centre, [&] { return piece(k, ".about"); }) && good;
    if (p.coefficients.empty() || p.coefficients.size() > rules::most_coefficients) {
      error(ErrorCode::wrong_count, piece(k, ".polynomial"),
            "found a list of " + std::to_string(p.coefficients.size()) + ", expected " +
                rules::coefficients);
      good = false;
    }
    for (std::size_t i = 0; i < p.coefficients.size(); ++i)
      good = finite(p.coefficients[i], [&] { return indexed(piece(k, ".polynomial"), i); }) && good;
  }
  if (!good || may_jump) return good;
  const auto jump = sentences::jump(f);
  if (jump) error(ErrorCode::contradiction, piece(jump->first, ""), jump->second);
  return !jump;
}

void Entity::function(const std::string& key, const TimeFunction& f, bool may_jump) const {
  if (f.formula && !may_jump && !f.formula->is_of_time())
    error(ErrorCode::wrong_value, key, sentences::formula_not_of_time(*f.formula));
  pieces(key, f.pieces, may_jump);
  if (f.period != 0.0 && number(key + ".period", f.period, rules::period))
    if (const auto text = sentences::period(f, may_jump))
      error(ErrorCode::contradiction, key + ".period", *text);
  for (std::size_t k = 0; k < f.sines.size(); ++k) {
    const SineTerm& s = f.sines[k];
    const bool chirp = s.rate != 0.0 || s.duration != 0.0;
    const std::string name = chirp ? ".chirp" : ".sine";
    const std::string sine = key + (f.sines.size() == 1 ? name : indexed(name, k));
    number(sine + ".amplitude", s.amplitude, any_number(""));
    number(sine + ".phase", s.phase, any_number("rad"));
    number(sine + ".start", s.start, any_number("s"));
    const NumberRule& frequency = chirp ? rules::chirp_frequency : rules::sine_frequency;
    number(sine + (chirp ? ".from" : ".frequency"), s.frequency,
           s.amplitude != 0.0 ? frequency : any_number("Hz"));
    if (!chirp) continue;
    if (!number(sine + ".duration", s.duration, rules::chirp_duration)) continue;
    const double to = s.frequency + s.rate * s.duration;
    number(sine + ".to", std::abs(to) < 1e-9 * s.frequency ? 0.0 : to, frequency);
  }
}

void Entity::signal(const std::string& key, const SignalDescription& s, const Names& names) const {
  function(key, s, true);
  if (!s.input.empty()) reference(key + ".input", "input", s.input, names.inputs);
  if (!word(key + ".source", s.source, signal_source_words)) return;
  if (s.source == SignalSource::none) return;
  if (s.formula && !s.formula->is_of_time())
    error(ErrorCode::exclusive, key, sentences::formula_and_source(s.source));
  const bool controller = s.source == SignalSource::controller;
  const std::string source = key + "." + signal_source_words[index_of(s.source)];
  reference(source, controller ? "controller" : "force", s.element,
            controller ? names.controllers : names.forces);
  number(key + ".factor", s.factor, any_number(""));
}

void name(const char* kind, const std::string& name, std::set<std::string>& taken,
          const Entity& entity) {
  bool good = !name.empty() && name.back() != '.';
  for (std::size_t from = 0; good && from < name.size();) {
    const std::size_t dot = std::min(name.find('.', from), name.size());
    good = is_identifier(std::string_view(name).substr(from, dot - from), true);
    from = dot + 1;
  }
  if (!good) {
    const std::string shown = name.size() > 40 ? name.substr(0, 40) + "..." : name;
    entity.errors.add(ErrorCode::wrong_value, entity.origin.mark,
                      kind + (": found the name '" + printable(shown)) +
                          "', expected letters, digits, _ and -, with a letter first");
  } else if (kind == std::string_view("bodies") && name == ground_name) {
    entity.error(ErrorCode::duplicate, "the name 'ground' is taken by the ground");
  } else if (!taken.insert(name).second) {
    entity.error(ErrorCode::duplicate, "the name is taken, expected a name used once");
  }
}

}  // namespace floatframe::validation
