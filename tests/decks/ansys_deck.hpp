#pragma once
// ANSYS decks for tests, laid out as CDWRITE does: blocked (NBLOCK, EBLOCK, CMBLOCK) or unblocked
// (N, EN).
#include <fmt/format.h>

#include <string>
#include <vector>

#include "floatframe/decks/ansys/read_ansys.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {

inline FeModel ansys_of(const std::string& text, const FeReadOptions& options = {}) {
  TextSource source(text, "a.cdb");
  return read_ansys(source, options);
}

inline std::string ansys_error(const std::string& text, const FeReadOptions& options = {}) {
  return error_of([&] { ansys_of(text, options); });
}

inline const std::string cdb_head =
    "/COM,ANSYS RELEASE 18.2    BUILD 18.2      UP20170627       10:00:00\n/PREP7\n/NOPR\n"
    "/TITLE,a part! 100 $ worth\n"
    "*IF,_CDRDOFF,EQ,1,THEN     !if solid model was read in\n"
    "_CDRDOFF=             !reset flag, numoffs already performed\n"
    "*ELSE              !offset database for the following FE model\n"
    "NUMOFF,NODE,       24\n*ENDIF\n*SET,_STATUS ,  1.000000000000\nDOF,DELETE\n";

/// A number in a column of 21, an exponent of three digits; trailing zeros are cut off by the
/// caller.
inline std::string cdb_real(double x) {
  std::string text = fmt::format("{:.13E}", x);
  const std::size_t e = text.find('E');
  text.insert(e + 2, "0");
  return fmt::format("{:>21}", text);
}

inline std::string cdb_nodes(const FeModel& m, bool blocked) {
  std::string text;
  if (blocked)
    text = fmt::format("NBLOCK,6,SOLID,{:10},{:10}\n(3i9,6e21.13e3)\n", m.nodes(), m.nodes());
  for (int i = 0; i < m.nodes(); ++i) {
    const Vec3& p = m.positions[i];
    if (blocked) {
      std::string line = fmt::format("{:9}{:9}{:9}", m.node_ids[i], 0, 0);
      const int last = p.z() != 0.0 ? 3 : p.y() != 0.0 ? 2 : 1;  // zeros at the end are cut off
      for (int k = 0; k < last; ++k) line += cdb_real(p(k));
      text += line + "\n";
    } else {
      text += fmt::format("N,R5.3,LOC,{:9},{:9},{:9}, {:.13E}    , {:.13E}    , {:.13E}\n",
                          m.node_ids[i], 0, 0, p.x(), p.y(), p.z());
    }
  }
  return text + "N,R5.3,LOC,       -1,\n";
}

struct CdbElement {
  int id = 0, type = 1, material = 1, real = 1, section = 1, system = 0;
  std::vector<int> nodes;
};

inline std::string cdb_elements(const std::vector<CdbElement>& elements, bool blocked) {
  std::string text;
  if (blocked)
    text = fmt::format("EBLOCK,19,SOLID,{:10},{:10}\n(19i9)\n", elements.size(), elements.size());
  for (const CdbElement& e : elements) {
    if (blocked)
      text += fmt::format("{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}{:9}", e.material, e.type,
                          e.real, e.section, e.system, 0, 0, 0, e.nodes.size(), 0, e.id);
    else
      text += fmt::format("EN,R5.5,ATTR,{:9},{:9},{:9},{:9},{:9},{:9},{:9},{:9}, 0, 0\n",
                          e.nodes.size(), e.material, e.type, e.real, e.section, e.system, e.id, 0);
    for (std::size_t k = 0; k < e.nodes.size(); ++k) {
      if (blocked) {
        text += fmt::format("{:9}", e.nodes[k]);
        if (k % 8 == 7 && k + 1 < e.nodes.size()) text += "\n";
      } else {
        text += fmt::format(
            "{}{:9},", k % 8 == 0 ? k == 0 ? "EN,R5.5,NODE," : "\nEN,R5.5,NODE," : "", e.nodes[k]);
      }
    }
    text += "\n";
  }
  return text + (blocked ? "       -1\n" : "EN,R5.5,ATTR,      -1\n");
}

/// Numbers in tens; three and more that follow each other as a range.
inline std::string cdb_component(const std::string& name, const char* kind,
                                 const std::vector<int>& numbers) {
  std::vector<int> list;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t end = k;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
    list.push_back(numbers[k]);
    if (end > k) list.push_back(end > k + 1 ? -numbers[end] : numbers[end]);
    k = end + 1;
  }
  std::string text = fmt::format("CMBLOCK,{:<8},{},{:8}  ! users {} component definition\n(8i10)\n",
                                 name, kind, list.size(), kind);
  for (std::size_t k = 0; k < list.size(); ++k)
    text += fmt::format("{:10}{}", list[k], k % 8 == 7 || k + 1 == list.size() ? "\n" : "");
  return text;
}

inline std::string cdb_material(int id, const std::vector<std::pair<std::string, double>>& values) {
  std::string text;
  for (const auto& [label, value] : values)
    text +=
        fmt::format("MPTEMP,R5.0, 1, 1,  0.00000000    ,\nMPDATA,R5.0, 1,{:<4},{:6}, 1, {:.16g},\n",
                    label, id, value);
  return text;
}

inline const std::string cdb_steel = cdb_material(
    1, {{"EX", 2.1e5}, {"NUXY", 0.3}, {"DENS", 7.85e-9}, {"ALPX", 1e-5}, {"PRXY", 0.3}});
/// Two opposite faces of a block.
inline const std::string cdb_square =
    "N,1,0,0,0\nN,2,2,0,0\nN,3,2,1,0\nN,4,0,1,0\nN,5,0,0,1\nN,6,2,0,1\nN,7,2,1,1\nN,8,0,1,1\n";
inline const std::string cdb_brick = "ET,1,185\n" + cdb_square + "E,1,2,3,4,5,6,7,8\n";
inline const std::string cdb_tail = "EXTOPT,ATTR,      0,      0,      0\n/GO\nFINISH\n";

}  // namespace floatframe::test
