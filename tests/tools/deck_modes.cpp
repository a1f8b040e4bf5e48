// deck_modes modes FILE [options of reading] [--modes N] [--held] [--ccx]: the frequencies of a
// finite-element file as JSON on standard output, for comparisons with other programs.
//   {"rows": 1275, "frequencies": [0, 0, 0, 0, 0, 0, 1234.5, ...]}      Hz in the units of the file
// --rigid: instead the mass in rigid motions about the origin, 6 x 6, as {"rigid_mass": [...]}.
// --held: the supports of the file are in force. --ccx: integration as in CalculiX. Rigid motions
// are near zero.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "floatframe/apps/command_parser.hpp"
#include "floatframe/apps/part_arguments.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/reduction/free_structure.hpp"

namespace floatframe {
namespace {

struct Arguments {
  PartArguments reading;
  std::string file;
  int modes = 20;
  bool held = false, ccx = false, rigid = false;
};

/// Supports of dofs that have no row hold something that other dofs carry.
std::vector<int> free_rows(const FeModel& model, const FeSystem& system) {
  std::set<int> held;
  for (const Support& s : model.supports)
    for (int axis = 0; axis < 6; ++axis) {
      if ((s.mask >> static_cast<unsigned>(axis) & 1u) == 0u) continue;
      const int row = system.row(s.node, axis);
      const bool turns = system.T_theta.rows() > 0 && axis >= 3 &&
                         system.T_theta.row(3 * s.node + axis - 3).nonZeros() > 0;
      const bool moves = axis < 3 && system.T.row(3 * s.node + axis).nonZeros() > 0;
      if (row >= 0)
        held.insert(row);
      else if (turns || moves)
        throw InputError(ErrorCode::dependent, model.mark(s.source),
                         fmt::format("the support of {} holds what depends on other nodes",
                                     model.node_label(s.node)));
    }
  std::vector<int> rows;
  for (int i = 0; i < system.size(); ++i)
    if (!held.contains(i)) rows.push_back(i);
  return rows;
}

SparseMatrix chosen(const SparseMatrix& A, const std::vector<int>& rows) {
  std::vector<int> place(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    place[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      const int row = place[static_cast<std::size_t>(it.row())];
      const int column = place[static_cast<std::size_t>(it.col())];
      if (row >= 0 && column >= 0) entries.emplace_back(row, column, it.value());
    }
  const auto n = static_cast<Eigen::Index>(rows.size());
  SparseMatrix out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

VecX values_about(const SparseMatrix& K, const SparseMatrix& M, double sigma, int modes) {
  const SparseMatrix A = K - sigma * M;
  const SparseFactors factors(A);
  if (factors.singular() >= 0)
    throw InputError(ErrorCode::wrong_value, "a degree of freedom has neither stiffness nor mass");
  const int count = std::min(modes, static_cast<int>(K.rows()));
  return lowest_eigenpairs(A, factors, sigma, M, count).lambda;
}

/// Below zero, and of the size of the lowest elastic eigenvalue: of one free part by its estimate,
/// of several by a fraction of the largest. Held masses tell nothing of how the part would move
/// freely.
double first_shift(const Arguments& a, const FeModel& model, const FeSystem& system,
                   const SparseMatrix& K, const SparseMatrix& M) {
  const double least = -1e-9 * K.diagonal().sum() / M.diagonal().sum();
  if (!std::isfinite(least))
    throw InputError(ErrorCode::wrong_value, "nothing that can move has a mass");
  const double sigma = a.held ? 0.0 : -elastic_estimate(model, system);
  return sigma < least ? sigma : 1e3 * least;
}

/// Of a held part once more where its lowest eigenvalue is much smaller than the shift, which takes
/// its digits.
VecX lowest_values(const Arguments& a, const SparseMatrix& K, const SparseMatrix& M, double sigma) {
  const VecX lambda = values_about(K, M, sigma, a.modes);
  const bool again = a.held && lambda.size() > 0 && lambda(0) > -1e-6 * sigma;
  return again && lambda(0) < -0.1 * sigma ? values_about(K, M, -lambda(0), a.modes) : lambda;
}

int show(const Arguments& a) {
  const PartJob job = a.reading.job();
  FeModel model = read_fe_file(a.file, job.read, job.format);
  validate(model);
  if (a.held) {  // nodes with a name keep their rows, those that only springs hold as well
    model.node_names.resize(model.positions.size());
    for (const Support& s : model.supports)
      if (model.node_names[static_cast<std::size_t>(s.node)].empty())
        model.node_names[static_cast<std::size_t>(s.node)] = fmt::format("held {}", s.node);
  }
  const FeSystem system = assemble(model, a.ccx ? Integration::ccx : Integration::exact);
  if (a.rigid) {
    const MatX R = rigid_motions(model, system, Vec3::Zero());
    const Mat6 mass = R.transpose() * (system.M * R);
    print(fmt::format("{{\"rigid_mass\": [{}]}}\n", fmt::join(mass.reshaped(), ", ")));
    return 0;
  }
  std::vector<int> rows;
  if (a.held) {
    rows = free_rows(model, system);
  } else {
    for (int i = 0; i < system.size(); ++i) rows.push_back(i);
  }
  const SparseMatrix K = chosen(system.K, rows), M = chosen(system.M, rows);
  const VecX lambda = lowest_values(a, K, M, first_shift(a, model, system, K, M));
  std::vector<double> frequencies;
  for (const double l : lambda)
    frequencies.push_back(std::copysign(hertz(std::sqrt(std::abs(l))), l));
  print(fmt::format("{{\"rows\": {}, \"frequencies\": [{}]}}\n", K.rows(),
                    fmt::join(frequencies, ", ")));
  return 0;
}

Command modes_command() {
  const auto a = std::make_shared<Arguments>();
  return {.name = "modes",
          .help = "The lowest frequencies of a finite-element file",
          .options = joined({file_position("FILE", a->file, "Finite-element file"),
                             whole_option("--modes", a->modes, 1, 10000, "How many; default 20"),
                             flag("--held", a->held, "With the supports of the file"),
                             flag("--rigid", a->rigid, "The mass in rigid motions instead"),
                             flag("--ccx", a->ccx, "Integration as in CalculiX")},
                            a->reading.table(true)),
          .run = [a] { return show(*a); }};
}

}  // namespace
}  // namespace floatframe

int main(int argc, char** argv) {
  using namespace floatframe;
  try {
    const ParsedCommand command = parse_command_line({modes_command()}, argc, argv);
    return command.run ? command.run() : command.exit_code;
  } catch (const std::exception& error) {
    say(error.what());
    return exit_code::bad_input;
  }
}
