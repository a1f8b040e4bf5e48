// Beams of Nastran whose section changes along them, against closed forms and a fine chain.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_text.hpp"

namespace floatframe::test {
namespace {

/// A cantilever of length 10 along x, held at node 1.
std::string cantilever(const std::string& property, const std::string& more = "") {
  return "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\nCBEAM,1,1,1,2,0.,1.,0.\n" +
         property + more;
}

struct Held {
  MatX K, M;
  std::vector<Dof> dofs;
  int row(int node, int axis) const {
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dofs[i].node == node && dofs[i].axis == axis) return static_cast<int>(i);
    return -1;
  }
};

Held held(const FeModel& model) {
  const FeSystem system = assemble(model);
  std::vector<int> rows;
  Held out;
  for (int i = 0; i < system.size(); ++i) {
    const Dof d = system.dofs[static_cast<std::size_t>(i)];
    if (d.node == 0) continue;
    rows.push_back(i);
    out.dofs.push_back(d);
  }
  out.K = MatX(system.K)(rows, rows);
  out.M = MatX(system.M)(rows, rows);
  return out;
}

/// Displacement of node 2 along an axis under a unit force there.
double tip(const FeModel& model, int axis) {
  const Held h = held(model);
  VecX f = VecX::Zero(h.K.rows());
  f(h.row(1, axis)) = 1.0;
  return VecX(h.K.ldlt().solve(f))(h.row(1, axis));
}

/// int_0^1 (1 - x)^2/(a + (b - a) x) dx
double bending_integral(double a, double b) {
  const int n = 20000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    sum += (1 - x) * (1 - x) / (a + (b - a) * x) / n;
  }
  return sum;
}

TEST(NastranTapers, DeflectionsOfACantilever) {
  for (const double r : {1.02, 0.8, 2.0, 0.125}) {
    const auto times = [r](double x) { return std::to_string(r * x); };
    const FeModel model =
        valid_bdf(cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,1.," + times(.1) + "," + times(.2) + "," +
                             times(.3) + ",," + times(.4) + "\n,0.,0.\n"));
    const double E = 100, G = 40, L = 10, log_mean = (r - 1) / std::log(r);
    EXPECT_NEAR(tip(model, 0) / (L / (E * .1 * log_mean)), 1.0, 1e-3) << r;
    EXPECT_NEAR(tip(model, 3) / (L / (G * .4 * log_mean)), 1.0, 1e-9) << r;  // exact
    const double s = L * L * L / E * bending_integral(1, r);
    EXPECT_NEAR(tip(model, 1) / (s / .2), 1.0, 6e-4) << r;  // I1: in the plane of y
    EXPECT_NEAR(tip(model, 2) / (s / .3), 1.0, 6e-4) << r;
    EXPECT_GT(std::abs(tip(model, 1) / (L * L * L / (3 * E * .2)) - 1.0), 2e-3) << r;
    // Mass and its centre: int A (1 + (r - 1) x) dx.
    const FeSystem system = assemble(model);
    double mass = 0.0, moment = 0.0;
    for (int node = 0; node < model.nodes(); ++node) {
      const int row = system.row(node, 0);
      for (int other = 0; other < model.nodes(); ++other)
        mass += system.M.coeff(row, system.row(other, 0));
      moment += system.M.coeff(row, row) * model.positions[static_cast<std::size_t>(node)](0);
    }
    EXPECT_NEAR(mass, 2 * .1 * L * (1 + r) / 2, 1e-12);
    // Each piece has its mass in its middle.
    const double n = static_cast<double>(model.elements.size());
    EXPECT_NEAR(moment / mass, L * (1 + 2 * r) / (3 * (1 + r)),
                1.001 * L * std::abs(r - 1) / (6 * (1 + r) * n * n));
  }
}

// A wedge that narrows to a tenth, against 400 beams of the section in their middles.
TEST(NastranTapers, FrequenciesOfAFineChain) {
  const auto first = [](const FeModel& model) {
    const Held h = held(model);
    std::vector<int> bends;
    for (int i = 0; i < h.K.rows(); ++i)
      if (const int axis = h.dofs[static_cast<std::size_t>(i)].axis; axis == 1 || axis == 5)
        bends.push_back(i);
    return generalised_eigenvalues(MatX(h.K(bends, bends)), MatX(h.M(bends, bends))).values;
  };
  const int n = 400;
  std::string fine = "GRID,1,,0.,0.,0.\nMAT1,1,100.,,.25,2.\nPARAM,COUPMASS,1\n";
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n, A = .1 * (1 - .9 * x), I = .02 * (1 - .9 * x);
    const std::string id = std::to_string(i + 1), next = std::to_string(i + 2);
    fine += "GRID," + next + ",," + std::to_string(10. * (i + 1) / n) + ",0.,0.\nCBEAM," + id +
            "," + id + "," + id + "," + next + ",0.,1.,0.\nPBEAM," + id + ",1," +
            std::to_string(A) + "," + std::to_string(I) + ",.01,,.01\n,\n,0.,0.\n";
  }
  const VecX reference = first(valid_bdf(fine));
  const VecX found = first(valid_bdf(cantilever(
      "PBEAM,1,1,.1,.02,.01,,.01\n,NO,1.,.01,.002,.01,,.01\n,0.,0.\n", "PARAM,COUPMASS,1\n")));
  EXPECT_NEAR(std::sqrt(found(0) / reference(0)), 1.0, 1e-3);
  EXPECT_NEAR(std::sqrt(found(1) / reference(1)), 1.0, 1.5e-3);
}

TEST(NastranTapers, StationsAndEnds) {
  // Constant to the middle, then to a half; stations in any order; end B blank is as end A.
  const FeModel model = valid_bdf(
      cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,1.,.05,.1,.15,,.2\n,NO,.5,.1,.2,.3,,.4\n,0.,0.\n"));
  EXPECT_NEAR(tip(model, 0), 5 / (100 * .1) + 5 / (100 * .1) * 2 * std::log(2.), 7e-4);
  const FeModel blank =
      valid_bdf(cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,.5,.05,.2,.3,,.4\n,0.,0.\n"));
  EXPECT_NEAR(tip(blank, 0), 10 / (100 * .1) * 2 * std::log(2.), 7e-4);
  // What a station between the ends leaves blank lies between them.
  const FeModel between = valid_bdf(
      cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,.5,,.15,.3,,.4\n,NO,1.,.05,.1,.3,,.4\n,0.,0.\n"));
  EXPECT_NEAR(tip(between, 0), 10 / (100 * .1) * 2 * std::log(2.), 7e-4);
  // The same section along the beam is one beam.
  EXPECT_EQ(valid_bdf(cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,1.,.10005,.2,.3,,.4\n")).nodes(), 2);
  // Offsets and pins stay at the ends: a pin of the end bends nothing, the force moves the node.
  std::string offset = cantilever("PBEAM,1,1,.1,.2,.3,,.4\n,NO,1.,.05,.1,.15,,.2\n,0.,0.\n");
  offset.insert(offset.find("0.,1.,0.\n") + 8, "\n,,,0.,2.,0.,0.,2.,0.");
  const double axial = 10 / (100 * .1) * 2 * std::log(2.),
               bent = 4 * 10 / (100 * .2) * 2 * std::log(2.);
  EXPECT_NEAR(tip(valid_bdf(offset), 0), axial + bent, 7e-4);
  // Sets, names and notes are of the element.
  EXPECT_EQ(model.element_sets.at("PID 1").size(), model.elements.size());
  EXPECT_EQ(model.elements.back().id, 1);
  EXPECT_EQ(model.notes.at(0),
            "arm.bdf:5: PBEAM 1: its section changes along the beam: 1 elements are chains of " +
                std::to_string(model.elements.size()) +
                " beams of constant section, with nodes of their own");
}

// Nonstructural mass that changes, a density that the file does not have, a named section.
TEST(NastranTapers, MassAndNamedSections) {
  const auto mass = [](const FeModel& model) {
    const FeSystem system = assemble(model);
    VecX u = VecX::Zero(system.size());
    for (int i = 0; i < system.size(); ++i)
      if (system.dofs[static_cast<std::size_t>(i)].axis == 0) u(i) = 1.0;
    return u.dot(system.M * u);
  };
  EXPECT_NEAR(
      mass(valid_bdf(cantilever("PBEAM,1,1,.1,.2,.3,,.4,1.\n,NO,1.,.05,.1,.15,,.2,2.\n,0.,0.\n"))),
      2 * .075 * 10 + 15, 1e-12);
  const FeModel bar = valid_bdf(cantilever("PBEAML,1,1,,BAR\n,.4,.6,1.,NO,1.,.2,.6,1.\n"));
  EXPECT_NEAR(mass(bar), 2 * .18 * 10 + 10, 1e-12);
  EXPECT_NEAR(tip(bar, 0), 10 / (100 * .24) * 2 * std::log(2.), 7e-4);
  EXPECT_NEAR(bar.sections.back().width, .6, 1e-12);
}

TEST(NastranTapers, Errors) {
  const auto error = [](const std::string& stations) {
    return invalid_bdf(cantilever("PBEAM,1,1,.1,.2,.3,,.4\n," + stations));
  };
  EXPECT_EQ(error("NO,1.5,.1,.1,.15,,.2\n"), "arm.bdf:6: out_of_range");
  EXPECT_EQ(error("NO,.5,.1,.1,.15,,.2\n,NO,.5,.1,.1,.15,,.2\n"), "arm.bdf:7: duplicate");
  EXPECT_EQ(error("NO,1.,.1,-.1,.15,,.2\n"), "arm.bdf:5: out_of_range");
  std::string many;
  for (int i = 1; i < 60; ++i) many += "NO,." + std::to_string(100 + i) + ",.1\n,";
  EXPECT_EQ(error(many), "arm.bdf:5: wrong_count");
  EXPECT_EQ(invalid_bdf(cantilever("PBEAML,1,1,,BAR\n,.4,.6,1.,NO,.5,.2,,\n,NO,1.,.2,.6\n")),
            "arm.bdf:5: missing");
}

/// What is wrong with a card or an element is said once, not for each of its pieces.
TEST(NastranTapers, ErrorsOnce) {
  const std::string beam = "PBEAM,1,1,.1,.2,.3,,.4,1.\n,NO,1.,.05,.1,.15,,.2,2.\n,0.,0.\n";
  const auto error = [&](const std::string& from, const std::string& to) {
    std::string text = cantilever(beam);
    text.replace(text.find(from), from.size(), to);
    return invalid_bdf(text);
  };
  EXPECT_EQ(error("MAT1,1", "MAT1,2"), "arm.bdf:5: not_found");
  EXPECT_EQ(error("MAT1,1,100.,,.25,2.", "MAT8,1,100.,100.,.25,10."), "arm.bdf:5: wrong_value");
  EXPECT_EQ(error("100.,,.25", "100.,,"), "arm.bdf:3: wrong_count");
  EXPECT_EQ(error("100.,,.25", "100.,-1.,.25"), "arm.bdf:3: out_of_range");
  EXPECT_EQ(error("0.,1.,0.\n", "1.,0.,0.\n"), "arm.bdf:4: geometry");
  EXPECT_EQ(error("GRID,2,,10.", "GRID,2,,0."), "arm.bdf:4: geometry");
  EXPECT_EQ(error("\n,0.,0.\n", "\n,nan,0.\n"), "arm.bdf:7: not_a_number");
  EXPECT_EQ(error("\n,0.,0.\n", "\n,1.,-1.\n"), "arm.bdf:5: out_of_range");
}

// What changes alone.
TEST(NastranTapers, NonstructuralMassAndI12) {
  const FeModel mass =
      valid_bdf(cantilever("PBEAM,1,1,1.,2.,3.,,.4,0.\n,NO,1.,1.,2.,3.,,.4,20.\n,0.,0.\n"));
  EXPECT_GT(mass.elements.size(), 15u);
  const FeSystem system = assemble(mass);
  VecX shift = VecX::Zero(system.size()), turn = shift;
  for (int i = 0; i < system.size(); ++i) {
    const Dof d = system.dofs[static_cast<std::size_t>(i)];
    if (d.axis == 2) {
      shift(i) = 1.0;
      turn(i) = mass.positions[static_cast<std::size_t>(d.node)].x();
    } else if (d.axis == 4) {
      turn(i) = -1.0;
    }
  }
  EXPECT_NEAR(shift.dot(system.M * shift), 10.0 * (2.0 + 10.0), 1e-9);
  EXPECT_NEAR(shift.dot(system.M * turn), 2.0 * 50.0 + 100.0 * 20.0 / 3.0, 1.0);
  const auto turned = [](const char* end) {
    return cantilever("PBEAM,1,1,1.,.2,.3,0.,.4\n,NO,1.,1.,.2,.3," + std::string(end) + ",.4\n");
  };
  EXPECT_GT(valid_bdf(turned(".2")).elements.size(), 15u);
  EXPECT_EQ(invalid_bdf(turned(".4")), "arm.bdf:5: out_of_range");
}

TEST(NastranTapers, TaperedToNothing) {
  EXPECT_EQ(invalid_bdf(cantilever("PBEAML,1,1,,ROD\n,1.,0.,NO,1.,0.,0.\n")),
            "arm.bdf:5: out_of_range");
}

// Many tapered beams in few bytes become few pieces each.
TEST(NastranTapers, BoundedNumberOfPieces) {
  std::string text =
      "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\nBEAMOR,,1,,,0.,1.,0.\n"
      "PBEAM,1,1,.1,.2,.3,,.4\n,NO,1.,.01,.02,.03,,.04\n,0.,0.\n";
  const int n = 3000;
  for (int i = 1; i <= n; ++i) text += "CBEAM," + std::to_string(i) + ",,1,2\n";
  const FeModel model = valid_bdf(text);
  EXPECT_LT(model.elements.size(), 1000u + 3u * n);
  EXPECT_GE(model.elements.size(), 2u * n);
  EXPECT_TRUE(contains(model.notes.at(0), "(fewer than for 0.05 %, by "));
}

}  // namespace
}  // namespace floatframe::test
