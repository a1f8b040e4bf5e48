// Constraint equations, coupled degrees of freedom, rigid regions, supports.

#include <algorithm>
#include <array>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {
namespace {

constexpr std::array ansys_axes = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

int axis_of(AnsysFields& f, std::size_t k) {
  const int axis = ansys_axis(f.text(k));
  if (axis < 0)
    f.stop(ErrorCode::wrong_value, "{}: expected a degree of freedom UX to ROTZ, found {}",
           f.command(), shown(f.text(k)));
  return axis;
}

/// Node, label and factor from field 3 on.
void append_terms(AnsysFields& f, AnsysEquation& e) {
  for (std::size_t k = 3; k < f.size() && !f.blank(k); k += 3)
    e.terms.push_back({f.label(k, "the node"), axis_of(f, k + 1), f.real(k + 2, "the factor")});
}

/// A number, or NEXT: the one above all others; HIGH: the highest.
template <typename Map>
int number_in(AnsysFields& f, std::size_t k, const Map& map) {
  const int highest = map.empty() ? 0 : map.rbegin()->first;
  if (f.word(k) == "NEXT") return highest + 1;
  if (f.word(k) == "HIGH") return std::max(highest, 1);
  return f.label(k, "the number of the set");
}

/// What a constraint of a whole selection would need.
void refuse_selection(AnsysFields& f, std::size_t k) {
  const std::string word = f.word(k);
  if (f.number(k) || word.empty()) return;
  f.stop(ErrorCode::unsupported,
         "{}: {} needs the selection or component of the session, only numbers of nodes are read; "
         "write the model with CDWRITE",
         f.command(), shown(f.text(k)));
}

/// CE,R5.0,DEFI,number,terms,constant and CE,R5.0,NODE,node,label,factor,...;
/// CE,number,constant,node,label,factor,...
void read_ansys_equation(AnsysFields& f, AnsysContent& c) {
  if (!ansys_written(f)) {
    const int number = number_in(f, 1, c.equations);
    refuse_selection(f, 3);
    AnsysEquation& e = c.equations[number];
    e.at = f.at();
    e.constant = f.real(2, "the constant");
    return append_terms(f, e);
  }
  if (f.word(2) == "DEFI") {
    c.constraint = f.label(3, "the number of the equation");
    c.equations[c.constraint] = {{}, f.real(5, "the constant"), f.at()};
    return;
  }
  if (f.word(2) != "NODE" || c.equations.empty())
    f.stop(ErrorCode::wrong_value, "CE: expected DEFI, then NODE, found {}", shown(f.text(2)));
  append_terms(f, c.equations[c.constraint]);
}

/// CP,R5.0,DEFI,number,...,label and CP,R5.0,NODE,nodes; CP,number,label,nodes.
void read_ansys_coupling(AnsysFields& f, AnsysContent& c) {
  const bool written = ansys_written(f);
  if (written && f.word(2) == "NODE") {
    if (c.couplings.empty())
      f.stop(ErrorCode::contradiction, "CP: NODE, but there is no DEFI before");
  } else {
    const std::size_t at = written ? 3 : 1;
    c.constraint = number_in(f, at, c.couplings);
    AnsysCoupling& coupling = c.couplings[c.constraint];
    coupling.at = f.at();
    std::size_t label = at + 1;
    while (written && label + 1 < f.size() && ansys_axis(f.text(label)) < 0) ++label;
    coupling.axis = axis_of(f, label);
    if (written) return;
  }
  AnsysCoupling& coupling = c.couplings[c.constraint];
  for (std::size_t k = 3; k < f.size(); ++k) {
    if (f.blank(k)) continue;
    refuse_selection(f, k);
    coupling.nodes.push_back(f.label(k, "the node"));
  }
}

/// CERIG,master,slave,label,...
void read_ansys_rigid(AnsysFields& f, AnsysContent& c) {
  refuse_selection(f, 1);
  refuse_selection(f, 2);
  AnsysRigid rigid;
  rigid.at = f.at();
  rigid.master = f.label(1, "the master node");
  rigid.slave = f.label(2, "the slave node");
  rigid.mask = 0;
  for (std::size_t k = 3; k < 8; ++k) {
    const std::string word = f.word(k);
    if (word.empty() && k > 3) continue;
    if (word.empty() || word == "ALL") {
      rigid.mask = 63u;
    } else if (word == "UXYZ" || word == "RXYZ") {
      rigid.mask |= word == "UXYZ" ? 7u : 56u;
    } else {
      rigid.mask |= 1u << axis_of(f, k);
    }
  }
  c.rigid.push_back(rigid);
}

/// D,node,label,value,value2,last,increment,label,...
void read_ansys_support(AnsysFields& f, AnsysContent& c) {
  if (!f.number(1)) {
    c.ignored.try_emplace("D of a selection", f.at());
    return;
  }
  for (const std::size_t k : {2u, 7u, 8u, 9u, 10u, 11u}) {
    const std::string word = f.word(k);
    if (word.empty()) continue;
    const int axis = ansys_axis(word);
    if (axis < 0 && word != "ALL") continue;  // of another field of physics
    c.supports.push_back({{f.label(1, "the node"), axis, 0.0}, f.at()});
  }
}

constexpr AnsysCommand constraint_commands[] = {
    {"CE", read_ansys_equation},
    {"CP", read_ansys_coupling},
    {"CERIG", read_ansys_rigid},
    {"D", read_ansys_support},
};

}  // namespace

int ansys_axis(std::string_view word) noexcept {
  for (std::size_t k = 0; k < ansys_axes.size(); ++k)
    if (same_word(word, ansys_axes[k])) return static_cast<int>(k);
  return -1;
}

std::span<const AnsysCommand> ansys_constraint_commands() { return constraint_commands; }

}  // namespace floatframe
