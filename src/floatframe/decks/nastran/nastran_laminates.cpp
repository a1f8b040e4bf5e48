// Shell properties: PSHELL, PCOMP and PCOMPG. Plies from the bottom, the first at Z0 from the nodes
// along the normal.
#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// One ply of four fields; blank materials and thicknesses are those of the ply before.
void read_nastran_ply(NastranFields& f, std::size_t first, NastranProperty& p) {
  const std::string what = fmt::format("ply {}", p.plies.size() + 1);
  NastranPly ply;
  const bool before = !p.plies.empty();
  if (f.blank(first) && before) {
    ply.material = p.plies.back().material;
  } else {
    ply.material = f.label(first, ("the material of " + what).c_str());
  }
  if (f.blank(first + 1) && before) {
    ply.thickness = p.plies.back().thickness;
  } else {
    ply.thickness = f.real(first + 1, ("the thickness of " + what).c_str());
    if (!(ply.thickness > 0.0))
      f.error(ErrorCode::out_of_range, "the thickness of {} is {:g}, expected more than 0", what,
              ply.thickness);
  }
  ply.angle = f.real(first + 2, ("the angle of " + what).c_str(), 0.0) * std::numbers::pi / 180.0;
  p.plies.push_back(ply);
}

/// LAM: which side is given, or what of the stiffness counts.
bool read_lam(NastranFields& f, NastranProperty& p) {
  const std::string_view lam = f.text(7);
  if (same_word(lam, "SYM")) return true;
  p.smeared = same_word(lam, "SMEAR");
  p.membrane = same_word(lam, "MEM");
  if (lam.empty() || p.smeared || p.membrane) return false;
  f.error(ErrorCode::wrong_value,
          "LAM is {}, expected blank, SYM, MEM or SMEAR (BEND has no stiffness in the plane)",
          shown(lam));
  return false;
}

}  // namespace

void read_nastran_pshell(NastranFields& f, NastranProperty& p) {
  // A material 0 is blank: so pre-processors punch what is missing.
  const auto blank = [&](std::size_t i) { return f.blank(i) || parse_integer(f.text(i)) == 0; };
  if (blank(1) && !blank(3))
    return f.error(ErrorCode::unsupported,
                   "MID1 is blank: a plate without stiffness in its plane is not supported");
  p.material = f.label(1, "the material");
  p.thickness = f.real(2, "the thickness");
  p.membrane = blank(3);
  if (p.membrane) {
    for (const auto& [at, name] : {std::pair{5, "MID3"}, std::pair{10, "MID4"}})
      if (!blank(at))
        f.error(ErrorCode::contradiction,
                "{} is {}, but MID2 is blank: a membrane has neither bending nor transverse shear",
                name, shown(f.text(at)));
  } else if (f.text(3) == "-1") {
    f.error(ErrorCode::unsupported, "MID2 is -1: plane strain is not supported");
  } else {
    p.bending = f.label(3, "MID2");
  }
  p.bending_factor = f.real(4, "12I/T**3", 1.0);
  if (!(p.bending_factor > 0.0))
    f.error(ErrorCode::out_of_range, "12I/T**3 is {:g}, expected more than 0", p.bending_factor);
  if (!blank(5) && !p.membrane) {
    p.shear_material = f.label(5, "MID3");
    p.shell_shear = f.real(6, "TS/T", 5.0 / 6.0) * p.thickness;
    if (!(p.shell_shear > 0.0))
      f.error(ErrorCode::out_of_range, "TS/T is {}, expected more than 0", shown(f.text(6)));
  }
  p.nonstructural = f.real(7, "the nonstructural mass", 0.0);
  if (!blank(10) && !p.membrane) p.coupling = f.label(10, "MID4");
}

void read_nastran_pcomp(NastranFields& f, NastranProperty& p) {
  constexpr std::size_t most = 10000;
  const bool global = f.name() == "PCOMPG";
  if (!f.blank(1)) p.z0 = f.real(1, "Z0");
  p.nonstructural = f.real(2, "the nonstructural mass", 0.0);
  if (p.nonstructural < 0.0)
    f.error(ErrorCode::out_of_range, "the nonstructural mass is {:g}, expected no negative number",
            p.nonstructural);
  const bool symmetric = read_lam(f, p);
  const std::size_t step = global ? 8 : 4, offset = global ? 1 : 0;
  for (std::size_t i = 8; i < f.size() && p.plies.size() < most; i += step) {
    bool there = false;
    for (std::size_t k = 0; k < step; ++k) there = there || !f.blank(i + k);
    if (there) read_nastran_ply(f, i + offset, p);
  }
  if (p.plies.empty()) return f.error(ErrorCode::missing, "it has no plies");
  if (symmetric)
    for (std::size_t k = p.plies.size(); k-- > 0;) p.plies.push_back(p.plies[k]);
  p.material = p.plies.front().material;
  for (const NastranPly& ply : p.plies) p.thickness += ply.thickness;
  p.shell_shear = 5.0 / 6.0 * p.thickness;
}

}  // namespace floatframe
