#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {
namespace {

using DofFactors = std::map<std::pair<int, int>, double>;

/// The largest factor of the block in the rows that are left.
std::pair<std::size_t, int> pivot_of(const std::vector<DofFactors>& rows, std::size_t from,
                                     int node, int first, double& most) {
  std::pair<std::size_t, int> best{from, first};
  most = 0.0;
  for (std::size_t r = from; r < rows.size(); ++r) {
    for (int axis = first; axis < first + 3; ++axis) {
      const auto it = rows[r].find({node, axis});
      if (it == rows[r].end() || !(std::abs(it->second) > most * (1.0 + 1e-9))) continue;
      most = std::abs(it->second);
      best = {r, axis};
    }
  }
  return best;
}

}  // namespace

void NastranEquations::add(int node, bool rotation, LinearEquation equation) {
  blocks_[{node, rotation}].push_back(std::move(equation));
}

/// Gauss and Jordan with full pivoting over the three directions of the block.
void NastranEquations::flush(FeModel& model, TextSource& source) {
  for (auto& [block, equations] : blocks_) {
    const auto& [node, rotation] = block;
    std::vector<DofFactors> rows;
    std::vector<FeSource> places;
    for (const LinearEquation& e : equations) {
      DofFactors& row = rows.emplace_back();
      for (const LinearEquation::Term& t : e.terms) row[{t.node, t.axis}] += t.factor;
      places.push_back(e.source);
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      double most = 0.0;
      const auto [best, axis] = pivot_of(rows, r, node, rotation ? 3 : 0, most);
      if (!(most > 1e-9)) {
        source.error(ErrorCode::duplicate, places[r],
                     "the equations for node {} hold a direction twice", model.node_ids[node]);
        break;
      }
      std::swap(rows[r], rows[best]);
      std::swap(places[r], places[best]);
      const double pivot = rows[r].at({node, axis});
      for (auto& [dof, factor] : rows[r]) factor /= pivot;
      for (std::size_t other = 0; other < rows.size(); ++other) {
        const auto it = rows[other].find({node, axis});
        if (other == r || it == rows[other].end()) continue;
        const double f = it->second;
        for (const auto& [dof, factor] : rows[r]) rows[other][dof] -= f * factor;
        rows[other].erase({node, axis});
      }
      LinearEquation& e = equations[r];
      e.terms = {{node, axis, 1.0}};  // the pivot; the rest when all are solved
    }
    for (std::size_t r = 0; r < rows.size() && source.errors() == 0; ++r) {
      LinearEquation e;
      e.source = places[r];
      e.terms = equations[r].terms;
      for (const auto& [dof, factor] : rows[r]) {
        const bool pivot = dof == std::pair{e.terms[0].node, e.terms[0].axis};
        if (!pivot && std::abs(factor) > 1e-15) e.terms.push_back({dof.first, dof.second, factor});
      }
      model.equations.push_back(std::move(e));
    }
  }
  blocks_.clear();
}

}  // namespace floatframe
