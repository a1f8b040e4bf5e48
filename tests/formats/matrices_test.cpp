// Stiffness and mass of other programs: an export of CalculiX with a rigid spider, and the same
// matrices written in every other format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

using test::error_of;
using test::TemporaryFolder;

const std::string matrices_folder = FLOATFRAME_TEST_DATA "/fe/";

/// Rigid motions of all rows: three translations, three rotations about the origin.
MatX rigid_motions(const FeModel& model) {
  const std::vector<Dof>& dofs = model.matrices->dofs;
  MatX R = MatX::Zero(static_cast<Eigen::Index>(dofs.size()), 6);
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const Eigen::Index row = static_cast<Eigen::Index>(i);
    const Vec3& p = model.positions[dofs[i].node];
    if (dofs[i].axis >= 3) {
      R(row, dofs[i].axis) = 1.0;
      continue;
    }
    R(row, dofs[i].axis) = 1.0;
    for (int k = 0; k < 3; ++k) R(row, 3 + k) = Vec3::Unit(k).cross(p)[dofs[i].axis];
  }
  return R;
}

struct Texts {
  std::string stiffness, mass, dofs;
};

/// K and M of a model, one line an entry: `line(row, column, value)` gives it, empty to leave out.
template <typename Line>
Texts written(const FeModel& model, Line line) {
  Texts texts;
  for (const bool stiffness : {true, false}) {
    const SparseMatrix& A = stiffness ? model.matrices->K : model.matrices->M;
    std::string& text = stiffness ? texts.stiffness : texts.mass;
    for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
      for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
        text += line(static_cast<int>(it.row()), static_cast<int>(it.col()), it.value());
      }
    }
  }
  texts.dofs = "node,dir\n# rows of the matrices\n";
  for (const Dof& d : model.matrices->dofs) {
    texts.dofs += fmt::format("{},{}\n", model.node_ids[d.node], d.axis + 1);
  }
  return texts;
}

FeModel node_table(const FeModel& model) {
  std::string text = "node,x,y,z\n";
  for (std::size_t k = 0; k < model.positions.size(); ++k) {
    const Vec3& p = model.positions[k];
    text += fmt::format("{},{},{},{}\n", model.node_ids[k], p.x(), p.y(), p.z());
  }
  TextSource source(text, "nodes.csv");
  return read_node_table(source);
}

/// The same matrices, whatever the order of the rows.
void expect_same(const FeModel& a, const FeModel& b) {
  const FeMatrices &x = *a.matrices, &y = *b.matrices;
  ASSERT_EQ(x.dofs.size(), y.dofs.size());
  std::map<std::pair<int, int>, Eigen::Index> row;
  for (std::size_t i = 0; i < y.dofs.size(); ++i) {
    row[{b.node_ids[y.dofs[i].node], y.dofs[i].axis}] = static_cast<Eigen::Index>(i);
  }
  ASSERT_EQ(x.K.nonZeros(), y.K.nonZeros());
  ASSERT_EQ(x.M.nonZeros(), y.M.nonZeros());
  const auto place = [&](Eigen::Index i) {
    const Dof& d = x.dofs[i];
    return row.at({a.node_ids[d.node], d.axis});
  };
  for (Eigen::Index j = 0; j < x.K.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(x.K, j); it; ++it) {
      EXPECT_EQ(it.value(), y.K.coeff(place(it.row()), place(j)));
    }
    for (SparseMatrix::InnerIterator it(x.M, j); it; ++it) {
      EXPECT_EQ(it.value(), y.M.coeff(place(it.row()), place(j)));
    }
  }
}

FeModel two_bricks() { return read_fe_file(matrices_folder + "two_bricks.sti.gz"); }

TEST(Matrices, CalculixExportWithARigidSpider) {
  const FeModel model = two_bricks();
  ASSERT_TRUE(model.matrices.has_value());
  const FeMatrices& matrices = *model.matrices;
  ASSERT_EQ(matrices.dofs.size(), 30u);
  // Node 21 is the rotation node of node 20.
  EXPECT_EQ(model.node_ids[matrices.dofs[27].node], 20);
  EXPECT_EQ(matrices.dofs[27].axis, 3);
  EXPECT_EQ(matrices.dofs[29].axis, 5);
  // The nodes that follow node 20 are not there, nor is node 21.
  EXPECT_EQ(model.nodes(), 9);
  EXPECT_EQ(model.node_sets.at("FOOT").size(), 4u);
  EXPECT_EQ(model.node_sets.at("NALL").size(), 9u);
  EXPECT_FALSE(model.node_sets.contains("TOP"));
  EXPECT_TRUE(model.elements.empty());
  EXPECT_TRUE(model.spiders.empty());
  const MatX K = matrices.K, M = matrices.M, R = rigid_motions(model);
  EXPECT_EQ(K, K.transpose());
  EXPECT_EQ(M, M.transpose());
  // Rigid motions give no force, rotations included: the rows of node 21 are rotations.
  EXPECT_LT((K * R).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
  // Two bricks of 1 x 1 x 1 mm: mass and, about the origin, inertia of a box of 1 x 1 x 2.
  const MatX rigid = R.transpose() * M * R;
  const double m = 2.0 * 7.85e-9;
  EXPECT_NEAR(rigid(0, 0), m, 1e-12 * m);
  EXPECT_NEAR(rigid(3, 3), m * (1.0 / 3.0 + 4.0 / 3.0), 1e-12 * m);
  EXPECT_NEAR(rigid(5, 5), m * (1.0 / 3.0 + 1.0 / 3.0), 1e-12 * m);
  EXPECT_NEAR(rigid(0, 4), m * 1.0, 1e-12 * m);
  ASSERT_EQ(model.notes.size(), 2u);
  EXPECT_EQ(model.notes[1], matrices_folder +
                                "two_bricks.inp:31: spider 'TOP' is in the matrices already: its 4 "
                                "nodes have no rows, its "
                                "reference is node 20");
}

TEST(Matrices, MatrixMarketSymmetricAndGeneral) {
  const FeModel model = two_bricks();
  const FeModel nodes = node_table(model);
  for (const bool general : {false, true}) {
    int count[2] = {0, 0};
    const auto keep = [&](int i, int j) { return general || i >= j; };
    const auto count_of = [&](const SparseMatrix& A) {
      int n = 0;
      for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
        for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
          n += keep(static_cast<int>(it.row()), static_cast<int>(it.col())) ? 1 : 0;
        }
      }
      return n;
    };
    count[0] = count_of(model.matrices->K);
    count[1] = count_of(model.matrices->M);
    const Texts texts = written(model, [&](int i, int j, double v) {
      return keep(i, j) ? fmt::format("{} {} {}\n", i + 1, j + 1, v) : std::string();
    });
    const auto whole = [&](const std::string& entries, int n) {
      return fmt::format("%%MatrixMarket matrix coordinate real {}\n% a comment\n30 30 {}\n{}",
                         general ? "general" : "symmetric", n, entries);
    };
    TextSource K(whole(texts.stiffness, count[0]), "K.mtx"),
        M(whole(texts.mass, count[1]), "M.mtx"), dofs(texts.dofs, "dofs.csv");
    expect_same(model, read_matrix_market(K, M, dofs, nodes));
  }
}

// arm_C.mtx beside arm_K.mtx, job_DMPV1.mtx beside job_STIF1.mtx, or a file that is named; a row
// that the stiffness does not have is an error.
TEST(Matrices, ViscousDampingInAnotherFile) {
  const FeModel model = two_bricks();
  const TemporaryFolder folder;
  const Texts triples = written(model, [&](int i, int j, double v) {
    return i <= j ? fmt::format("{} {} {}\n", i + 1, j + 1, v) : std::string();
  });
  const auto market = [&](const std::string& entries) {
    return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n{2}",
                       model.matrices->dofs.size(),
                       std::count(entries.begin(), entries.end(), '\n'), entries);
  };
  std::string nodes;
  for (int k = 0; k < model.nodes(); ++k)
    nodes += fmt::format("{},{},{},{}\n", model.node_ids[k], model.positions[k].x(),
                         model.positions[k].y(), model.positions[k].z());
  folder.write("arm_K.mtx", market(triples.stiffness));
  folder.write("arm_M.mtx", market(triples.mass));
  folder.write("arm_dofs.csv", triples.dofs);
  folder.write("arm_nodes.csv", nodes);
  EXPECT_EQ(read_fe_file(folder / "arm_K.mtx").matrices->C.size(), 0);
  EXPECT_TRUE(damping_beside(folder / "arm_K.mtx").empty());
  folder.write("arm_C.mtx", market(triples.mass));
  EXPECT_EQ(damping_beside(folder / "arm_K.mtx"), folder / "arm_C.mtx");
  const FeModel damped = read_fe_file(folder / "arm_K.mtx");
  EXPECT_EQ(MatX(damped.matrices->C), MatX(damped.matrices->M));
  EXPECT_EQ(damped.files.back(), folder.file("arm_C.mtx"));
  const Texts labels = written(model, [&](int i, int j, double v) {
    const Dof &a = model.matrices->dofs[i], &b = model.matrices->dofs[j];
    return fmt::format("{},{}, {},{}, {:.17e}\n", model.node_ids[a.node], a.axis + 1,
                       model.node_ids[b.node], b.axis + 1, v);
  });
  folder.write("job_STIF1.mtx", labels.stiffness);
  folder.write("job_MASS1.mtx", labels.mass);
  folder.write("job_DMPV1.mtx", labels.mass);
  folder.write("job_nodes.csv", nodes);
  const FeModel abaqus = read_fe_file(folder / "job_STIF1.mtx");
  EXPECT_EQ(MatX(abaqus.matrices->C), MatX(abaqus.matrices->M));
  FeReadOptions named;
  const Dof& first = model.matrices->dofs[0];
  named.damping_matrix =
      folder.write("dashpots.mtx", fmt::format("{0},{1}, {0},{1}, 2.5\n{0},{1}, 999,6, 0\n",
                                               model.node_ids[first.node], first.axis + 1));
  const std::string error = error_of([&] { read_fe_file(folder / "job_STIF1.mtx", named); });
  EXPECT_EQ(folder.without(error), "dashpots.mtx:2: not_found");
}

TEST(Matrices, AbaqusLabelsInOneTriangleOrBoth) {
  const FeModel model = two_bricks();
  const FeModel nodes = node_table(model);
  for (const int halves : {0, 1, 2}) {
    const Texts texts = written(model, [&](int i, int j, double v) {
      if ((halves == 0 && i > j) || (halves == 1 && i < j)) return std::string();
      const Dof &a = model.matrices->dofs[i], &b = model.matrices->dofs[j];
      return fmt::format("{},{}, {},{}, {:.17e}\n", model.node_ids[a.node], a.axis + 1,
                         model.node_ids[b.node], b.axis + 1, v);
    });
    TextSource K(texts.stiffness, "arm_STIF1.mtx"), M(texts.mass, "arm_MASS1.mtx");
    expect_same(model, read_abaqus_matrices(K, M, nullptr, nodes));
  }
}

TEST(Matrices, AbaqusCoordinatesWithAMap) {
  const FeModel model = two_bricks();
  const Texts texts = written(model, [&](int i, int j, double v) {
    return i <= j ? fmt::format("{} {} {}\n", i + 1, j + 1, v) : std::string();
  });
  TextSource K(texts.stiffness, "arm_STIF1.mtx"), M(texts.mass, "arm_MASS1.mtx"),
      dofs(texts.dofs, "dofs.csv");
  expect_same(model, read_abaqus_matrices(K, M, &dofs, node_table(model)));
}

TEST(Matrices, FormatsAreKnownByEndingAndContent) {
  const auto format_of = [](const std::string& text) {
    std::string names;
    for (const FeFormat& f : fe_formats()) {
      if (f.recognise(text)) names += fmt::format("{} ", f.name);
    }
    return names;
  };
  EXPECT_EQ(format_of("** deck\n*NODE\n1, 0.\n"), "abaqus ");
  EXPECT_EQ(format_of("1 1  2.9329812481986e+06\n1 2 -1.7403212093851e+05\n"),
            "calculix_matrices ");
  EXPECT_EQ(format_of("1,1, 1,1,  2.93e+06\n"), "abaqus_matrices ");
  EXPECT_EQ(format_of("%%MatrixMarket matrix coordinate real symmetric\n"), "matrix_market ");
}

}  // namespace
}  // namespace floatframe
