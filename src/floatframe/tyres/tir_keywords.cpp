#include "floatframe/tyres/tir_keywords.hpp"

#include <map>

#include "floatframe/core/text_pieces.hpp"

namespace floatframe {

namespace {

/// Keywords of one kind, between blanks.
struct KeywordGroup {
  const char* names;
  TirKeyword meaning;
};

using Dim = TirDimension;
constexpr TirKeyword unused{Dim::none, 0.0, false, false};

constexpr KeywordGroup keyword_groups[] = {
    {"TYRESIDE PROPERTY_FILE_FORMAT FUNCTION_NAME TYPE COORDINATE_SYSTEM CONTACT_MODEL",
     {Dim::word}},
    {"FITTYP", {Dim::none}},
    {"USE_MODE FE_METHOD N_TIRE_STATES HMAX_LOCAL SWITCH_INTEG MFSAFE1 MFSAFE2 MFSAFE3", unused},
    {"LONGVL", {Dim::speed, 16.7}},
    {"VXLOW", {Dim::speed, 1.0}},
    {"UNLOADED_RADIUS WIDTH RIM_RADIUS RIM_WIDTH BOTTOM_OFFST", {Dim::length}},
    {"ASPECT_RATIO", {Dim::none, 0.6}},
    {"INFLPRES NOMPRES", {Dim::pressure}},
    {"MASS BELT_MASS", {Dim::mass}},
    {"IXX IYY BELT_IXX BELT_IYY", {Dim::inertia}},
    {"GRAVITY", unused},
    {"FNOMIN Q_FYS1 Q_FYS2 Q_FYS3", {Dim::force}},
    {"VERTICAL_STIFFNESS LONGITUDINAL_STIFFNESS LATERAL_STIFFNESS BOTTOM_STIFF", {Dim::stiffness}},
    {"VERTICAL_DAMPING", {Dim::damping}},
    {"BREFF DREFF FREFF Q_V1 Q_V2 Q_FZ1 Q_FZ2 Q_FCX Q_FCY Q_FCY2 Q_CAM1 Q_CAM3 PFZ1", {Dim::none}},
    {"Q_RE0", {Dim::none, 1.0}},
    {"Q_CAM2", {Dim::per_length}},
    {"MC_CONTOUR_A MC_CONTOUR_B Q_CAM Q_FZ3 PFZ2", unused},
    {"PCFX1 PCFX2 PCFX3 PCFY1 PCFY2 PCFY3 Q_RA1 Q_RA2 Q_RB1 Q_RB2", {Dim::none}},
    {"YAW_STIFFNESS FREQ_LONG FREQ_LAT FREQ_YAW FREQ_WINDUP DAMP_LONG DAMP_LAT DAMP_YAW "
     "DAMP_WINDUP DAMP_RESIDUAL DAMP_VLOW Q_BVX Q_BVT PCMZ1 Q_A1 Q_A2 ELLIPS_SHIFT ELLIPS_LENGTH "
     "ELLIPS_HEIGHT ELLIPS_ORDER ELLIPS_MAX_STEP ELLIPS_NWIDTH ELLIPS_NLENGTH ENV_C1 ENV_C2 "
     "ROAD_INCREMENT ROAD_DIRECTION",
     unused},
    {"PRESMIN PRESMAX", {Dim::pressure}},
    {"FZMIN FZMAX", {Dim::force}},
    {"KPUMIN KPUMAX", {Dim::none}},
    {"ALPMIN ALPMAX CAMMIN CAMMAX", {Dim::angle}},
    {"LFZO LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY LTR LRES LGAZ LXAL LYKA "
     "LVYKA LS LSGKP LSGAL LMX LVMX LMY LKYC LKZC",
     {Dim::none, 1.0, true}},
    {"LMUV LGYR LMP LIP LCZ LKC", {Dim::none, 1.0, true, false}},
    {"PCX1 PDX1 PDX2 PDX3 PEX1 PEX2 PEX3 PEX4 PKX1 PKX2 PKX3 PHX1 PHX2 PVX1 PVX2 PPX1 PPX2 PPX3 "
     "PPX4 RBX1 RBX2 RBX3 RCX1 REX1 REX2 RHX1 PTX1 PTX2 PTX3",
     {Dim::none}},
    {"QSX1 QSX2 QSX3 QSX4 QSX5 QSX6 QSX7 QSX8 QSX9 QSX10 QSX11 QSX12 QSX13 QSX14 PPMX1",
     {Dim::none}},
    {"PCY1 PDY1 PDY2 PDY3 PEY1 PEY2 PEY3 PEY4 PEY5 PKY1 PKY2 PKY3 PKY5 PKY6 PKY7 PHY1 PHY2 PHY3 "
     "PVY1 PVY2 PVY3 PVY4 PPY1 PPY2 PPY3 PPY4 PPY5 RBY1 RBY2 RBY3 RBY4 RCY1 REY1 REY2 RHY1 RHY2 "
     "RVY1 RVY2 RVY3 RVY4 RVY5 RVY6 PTY1 PTY2",
     {Dim::none}},
    {"PKY4", {Dim::none, 2.0}},
    {"QSY1 QSY2 QSY3 QSY4 QSY5 QSY6 QSY8", {Dim::none}},
    {"QSY7", {Dim::none, 1.0}},
    {"QBZ1 QBZ2 QBZ3 QBZ4 QBZ5 QBZ9 QBZ10 QCZ1 QDZ1 QDZ2 QDZ3 QDZ4 QDZ6 QDZ7 QDZ8 QDZ9 QDZ10 "
     "QDZ11 QEZ1 QEZ2 QEZ3 QEZ4 QEZ5 QHZ1 QHZ2 QHZ3 QHZ4 PPZ1 PPZ2 SSZ1 SSZ2 SSZ3 SSZ4",
     {Dim::none}},
    {"PDXP1 PDXP2 PDXP3 PKYP1 PDYP1 PDYP2 PDYP3 PDYP4 PHYP1 PHYP2 PHYP3 PHYP4 PECP1 PECP2 QDTP1 "
     "QCRP1 QCRP2 QBRP1 QDRP1 QDRP2 QTZ1 MBELT",
     unused},
};

using KeywordTable = std::map<std::string, TirKeyword, std::less<>>;
const KeywordTable& keyword_table() {
  static const KeywordTable table = [] {
    KeywordTable all;
    for (const KeywordGroup& group : keyword_groups)
      for (const std::string& name : pieces_of(group.names, ' ')) all.emplace(name, group.meaning);
    return all;
  }();
  return table;
}

struct UnitWord {
  TirDimension quantity;
  const char* words;  ///< those of one unit, between blanks
  double value;
};
constexpr double pound_force = 4.4482216152605;  ///< [N]
constexpr UnitWord unit_words[] = {
    {Dim::length, "meter metre meters metres m", 1.0},
    {Dim::length, "millimeter millimetre millimeters mm", 1e-3},
    {Dim::length, "centimeter centimetre centimeters cm", 1e-2},
    {Dim::length, "kilometer kilometre kilometers km", 1e3},
    {Dim::length, "inch inches in", 0.0254},
    {Dim::length, "foot feet ft", 0.3048},
    {Dim::length, "mile miles", 1609.344},
    {Dim::force, "newton newtons n", 1.0},
    {Dim::force, "kilonewton kilonewtons kn", 1e3},
    {Dim::force, "pound_force pounds_force pound lbf", pound_force},
    {Dim::force, "kpound_force klbf", 1e3 * pound_force},
    {Dim::force, "kg_force kilogram_force kgf", 9.80665},
    {Dim::force, "ounce_force ozf", pound_force / 16.0},
    {Dim::force, "dyne", 1e-5},
    {Dim::angle, "radian radians rad", 1.0},
    {Dim::angle, "degree degrees deg", 3.14159265358979323846 / 180.0},
    {Dim::mass, "kilogram kilograms kg", 1.0},
    {Dim::mass, "gram grams g", 1e-3},
    {Dim::mass, "tonne megagram t", 1e3},
    {Dim::mass, "pound_mass pounds_mass lbm pound", 0.45359237},
    {Dim::mass, "slug slugs", pound_force / 0.3048},
    {Dim::mass, "slinch", pound_force / 0.0254},
    {Dim::pressure, "pascal pa", 1.0},
    {Dim::pressure, "kilopascal kpa", 1e3},
    {Dim::pressure, "megapascal mpa", 1e6},
    {Dim::pressure, "bar", 1e5},
    {Dim::pressure, "psi", pound_force / (0.0254 * 0.0254)},
    // Of time, which no keyword has alone: as a speed, whose unit is length/time.
    {Dim::speed, "second seconds sec s", 1.0},
    {Dim::speed, "millisecond milliseconds ms", 1e-3},
    {Dim::speed, "minute minutes min", 60.0},
    {Dim::speed, "hour hours h", 3600.0},
};

}  // namespace

std::optional<TirKeyword> tir_keyword(std::string_view keyword) {
  const auto it = keyword_table().find(keyword);
  if (it == keyword_table().end()) return std::nullopt;
  return it->second;
}

const std::vector<std::string>& tir_keyword_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, meaning] : keyword_table()) all.push_back(name);
    return all;
  }();
  return names;
}

std::optional<double> tir_unit(TirDimension quantity, std::string_view unit) {
  for (const UnitWord& row : unit_words) {
    if (row.quantity != quantity) continue;
    for (const std::string& name : pieces_of(row.words, ' '))
      if (name == unit) return row.value;
  }
  return std::nullopt;
}

std::string tir_unit_words(TirDimension quantity) {
  std::vector<std::string> first;
  for (const UnitWord& row : unit_words)
    if (row.quantity == quantity) first.push_back(pieces_of(row.words, ' ').front());
  return names_text(first, 8);
}

}  // namespace floatframe
