// Partial LDL^T of a front and the block-sparse LDL^T against dense Eigen factorisations.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "floatframe/math/block_ldlt.hpp"
#include "floatframe/math/partial_ldlt.hpp"
#include "floatframe/math/profile_ldlt.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

MatX random_spd(Random& random, int n) {
  const MatX a = random.matrix(n, n);
  return a * a.transpose() + MatX::Identity(n, n);
}

/// The lower triangle of `a` in a front with leading dimension ld; the upper one holds rubbish.
MatX front_of(const MatX& a, int ld) {
  MatX f = MatX::Zero(ld, a.cols());
  f.topRows(a.rows()).setConstant(12345.0);
  f.topRows(a.rows()).triangularView<Eigen::Lower>() = a;
  return f;
}

/// With room for whole lanes.
VecX padded(const VecX& b) {
  VecX p = VecX::Zero(front_stride(static_cast<int>(b.size())));
  p.head(b.size()) = b;
  return p;
}

TEST(PartialLdlt, FullFactorisationSolves) {
  Random random(1);
  for (int n = 1; n <= 23; ++n) {
    const MatX a = random_spd(random, n);
    MatX f = front_of(a, front_stride(n));
    VecX diagonal(n), b = padded(random.vector(n));
    ASSERT_EQ(partial_ldlt(f.data(), n, n, diagonal.data()), -1);
    EXPECT_EQ(diagonal, a.diagonal());
    const VecX expected = a.llt().solve(b.head(n));
    partial_forward(f.data(), n, n, b.data());
    partial_backward(f.data(), n, n, b.data());
    EXPECT_LT((b.head(n) - expected).norm(), 1e-12 * expected.norm()) << n;
  }
}

TEST(PartialLdlt, TrailingBlockIsTheSchurComplement) {
  Random random(2);
  for (int n = 2; n <= 19; ++n)
    for (int ne = 0; ne <= n; ++ne) {
      const MatX a = random_spd(random, n);
      MatX f = front_of(a, front_stride(n));
      VecX diagonal(n), b = padded(random.vector(n));
      ASSERT_EQ(partial_ldlt(f.data(), n, ne, diagonal.data()), -1);
      const int m = n - ne;
      if (m == 0 || ne == 0) continue;
      const MatX A11 = a.topLeftCorner(ne, ne), A21 = a.bottomLeftCorner(m, ne);
      const MatX schur = a.bottomRightCorner(m, m) - A21 * A11.llt().solve(A21.transpose());
      const MatX lower = f.block(ne, ne, m, m).triangularView<Eigen::Lower>();
      const MatX expected = schur.triangularView<Eigen::Lower>();
      EXPECT_LT((lower - expected).norm(), 1e-12 * a.norm());
      // Forward substitution leaves b2 - A21 A11^-1 b1 behind.
      const VecX rest = b.segment(ne, m) - A21 * A11.llt().solve(b.head(ne));
      partial_forward(f.data(), n, ne, b.data());
      EXPECT_LT((b.segment(ne, m) - rest).norm(), 1e-11 * (1.0 + rest.norm()));
    }
}

/// A band with a border, and how far its columns reach.
MatX bordered_band(Random& random, int n, int ne, int width, FrontProfile& profile) {
  MatX a = random_spd(random, n);
  profile.assign(ne, 0);
  for (int j = 0; j < ne; ++j) {
    const int end = std::min(ne, j + 1 + (j % width));
    profile[j] = std::max(j == 0 ? 0 : profile[j - 1], (end + 3) & ~3);
    for (int i = end; i < ne; ++i) a(i, j) = a(j, i) = 0.0;
  }
  a.diagonal().array() += 2.0 * n;
  return a;
}

TEST(ProfileLdlt, EqualsTheFullFactorisation) {
  Random random(4);
  for (const int border : {0, 1, 6, 9})
    for (int ne = 1; ne <= 30; ++ne) {
      const int n = ne + border, ld = front_stride(n);
      FrontProfile profile;
      const MatX a = bordered_band(random, n, ne, 6, profile);
      const VecX b0 = padded(random.vector(n));
      MatX full = front_of(a, ld), narrow = MatX::Constant(ld, n, std::nan(""));
      profile_clear(narrow.data(), n, ne, profile);
      for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i)
          if (a(i, j) != 0.0) narrow(i, j) = a(i, j);
      VecX diagonal(n), b = b0, c = b0;
      ASSERT_EQ(partial_ldlt(full.data(), n, ne, diagonal.data()), -1);
      ASSERT_EQ(profile_ldlt(narrow.data(), n, ne, diagonal.data(), profile), -1);
      for (int j = ne; j < n; ++j)
        for (int i = j; i < n; ++i) EXPECT_NEAR(narrow(i, j), full(i, j), 1e-11 * n);
      partial_forward(full.data(), n, ne, b.data());
      profile_forward(narrow.data(), n, ne, c.data(), profile);
      EXPECT_LT((b - c).norm(), 1e-12 * b.norm()) << ne << ' ' << border;
      partial_backward(full.data(), n, ne, b.data());
      profile_backward(narrow.data(), n, ne, c.data(), profile);
      EXPECT_LT((b - c).norm(), 1e-12 * b.norm()) << ne << ' ' << border;
    }
}

TEST(PartialLdlt, NamesTheVanishingPivot) {
  Random random(3);
  const int n = 9;
  for (int dependent = 1; dependent < n; ++dependent) {
    MatX g = random.matrix(n, n);
    g.row(dependent) = 0.3 * g.row(0);  // unknown `dependent` moves as unknown 0 does
    const MatX a = g * g.transpose();
    MatX f = front_of(a, front_stride(n));
    VecX diagonal(n);
    EXPECT_EQ(partial_ldlt(f.data(), n, n, diagonal.data()), dependent);
  }
  MatX a = random_spd(random, n);
  a(4, 4) = std::numeric_limits<double>::quiet_NaN();
  MatX f = front_of(a, front_stride(n));
  VecX diagonal(n);
  EXPECT_EQ(partial_ldlt(f.data(), n, n, diagonal.data()), 4);
}

TEST(PartialLdlt, IndefiniteFrontsAreSolvedToo) {
  Random random(4);
  MatX a = random_spd(random, 12);
  a.bottomRightCorner(3, 3) -= 100.0 * MatX::Identity(3, 3);
  MatX f = front_of(a, 12);
  VecX diagonal(12), b = random.vector(12);
  const VecX expected = a.fullPivLu().solve(b);
  ASSERT_EQ(partial_ldlt(f.data(), 12, 12, diagonal.data()), -1);
  partial_forward(f.data(), 12, 12, b.data());
  partial_backward(f.data(), 12, 12, b.data());
  EXPECT_LT((b - expected).norm(), 1e-11 * expected.norm());
}

// A penalty that ties two light blocks: the first takes all that the second has, so that its pivot
// is round-off, although it is not small beside what it starts with.
TEST(BlockLdlt, NamesAPivotThatTheOtherFrontsHaveTakenAway) {
  for (int trial = 1; trial <= 20; ++trial) {
    const double g[2] = {1.0 / 3.0, 0.1 * trial}, penalty = 7.3e7, mass = 1e-8;
    BlockLdlt sparse({1, 1}, {{0, 1}});
    sparse.set_zero();
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b <= a; ++b)
        sparse.add(a, 0, b, 0, penalty * g[a] * g[b] + (a == b ? mass : 0.0));
    EXPECT_GE(sparse.factorize(), 0) << trial;
  }
}

struct Graph {
  std::vector<int> sizes;
  std::vector<std::pair<int, int>> edges;
};

Graph random_graph(Random& random, int blocks, double density) {
  Graph g;
  for (int k = 0; k < blocks; ++k) g.sizes.push_back(1 + static_cast<int>(random(0.0, 6.99)));
  for (int a = 0; a < blocks; ++a)
    for (int b = a + 1; b < blocks; ++b)
      if (random(0.0, 1.0) < density)
        g.edges.push_back(random() > 0.0 ? std::pair{a, b} : std::pair{b, a});
  return g;
}

TEST(BlockLdlt, RandomPatternsAgainstDense) {
  Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    Graph g = random_graph(random, 1 + trial / 3, trial % 5 == 0 ? 0.0 : 0.25);
    if (!g.edges.empty()) g.edges.push_back(g.edges.front());  // repeated edges are allowed
    std::vector<int> start;
    int n = 0;
    for (const int s : g.sizes) {
      start.push_back(n);
      n += s;
    }
    BlockLdlt sparse(g.sizes, g.edges);
    for (int repeat = 0; repeat < 2; ++repeat) {  // the storage is used again
      MatX dense = MatX::Zero(n, n);
      sparse.set_zero();
      const auto add = [&](int a, int i, int b, int j, double x) {
        const int r = start[a] + i, c = start[b] + j;
        dense(r, c) += x;
        if (r != c) dense(c, r) += x;
        sparse.add(a, i, b, j, x);
      };
      for (int a = 0; a < static_cast<int>(g.sizes.size()); ++a) {
        const int s = g.sizes[a];
        for (int i = 0; i < s; ++i)
          for (int j = 0; j <= i; ++j) add(a, i, a, j, i == j ? 60.0 + random() : random());
      }
      for (const auto& [a, b] : g.edges)
        for (int i = 0; i < g.sizes[a]; ++i)
          for (int j = 0; j < g.sizes[b]; ++j) add(a, i, b, j, random());
      VecX x = random.vector(n);
      const VecX expected = dense.llt().solve(x);
      ASSERT_EQ(sparse.factorize(), -1);
      sparse.solve(x);
      EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm());
    }
  }
}

/// A symmetric indefinite matrix with zeros in some places of its diagonal, not singular.
MatX random_indefinite(Random& random, int n, int zeros) {
  MatX a = random.matrix(n, n);
  a = (a + a.transpose()).eval();
  for (int k = 0; k < zeros; ++k) a(k, k) = 0.0;
  return a;
}

TEST(PivotedLdlt, AgreesWithBlockElimination) {
  Random random(31);
  for (int n = 1; n <= 14; ++n)
    for (int ne = 1; ne <= n; ++ne) {
      const MatX a = random_indefinite(random, n, ne);
      MatX f = front_of(a, front_stride(n));
      PivotOrder pivots(ne);
      const MatX A11 = a.topLeftCorner(ne, ne);
      if (ne == 1) {  // its only pivot vanishes
        EXPECT_EQ(pivoted_ldlt(f.data(), n, ne, pivots, 1e-13), 0);
        continue;
      }
      ASSERT_EQ(pivoted_ldlt(f.data(), n, ne, pivots, 1e-13), -1) << n << ' ' << ne;
      const double worse = 1e-12 * A11.norm() * A11.inverse().norm();
      VecX b = VecX::Zero(front_stride(n));
      b.head(n) = random.vector(n);
      const VecX given = b.head(n);
      pivoted_forward(f.data(), n, ne, pivots, b.data());
      const int m = n - ne;
      const MatX A21 = a.bottomLeftCorner(m, ne);
      const VecX rest = given.tail(m) - A21 * A11.fullPivLu().solve(given.head(ne));
      EXPECT_LT((b.segment(ne, m) - rest).norm(), worse * (1.0 + rest.norm()));
      const MatX schur = a.bottomRightCorner(m, m) - A21 * A11.inverse() * A21.transpose();
      const MatX lower = f.block(ne, ne, m, m).triangularView<Eigen::Lower>();
      const MatX expected = schur.triangularView<Eigen::Lower>();
      EXPECT_LT((lower - expected).norm(), worse * (1.0 + schur.norm()));
      if (m > 0) b.segment(ne, m) = schur.fullPivLu().solve(rest);
      pivoted_backward(f.data(), n, ne, pivots, b.data());
      EXPECT_LT((a * b.head(n) - given).norm(), worse * (1.0 + b.norm()) * a.norm()) << n << ne;
    }
}

TEST(PivotedLdlt, NamesAColumnWithoutPivot) {
  Random random(32);
  for (int empty = 0; empty < 5; ++empty) {
    MatX a = random_indefinite(random, 5, 0);
    a.row(empty).setZero();
    a.col(empty).setZero();
    MatX f = front_of(a, front_stride(5));
    PivotOrder pivots(5);
    EXPECT_EQ(pivoted_ldlt(f.data(), 5, 5, pivots, 1e-13), empty);
  }
}

// Saddle points: every edge has multipliers in the block that is eliminated first. Blocks have full
// mass, or none at all: then their pivots are chosen.
TEST(BlockLdlt, SaddlePointsAgainstDense) {
  Random random(33);
  for (int trial = 0; trial < 40; ++trial) {
    Graph g = random_graph(random, 2 + trial / 4, 0.3);
    for (int& size : g.sizes) size += 3;
    const int count = static_cast<int>(g.sizes.size());
    std::vector<BlockLdlt::Block> blocks;
    // What has no mass of its own is held by springs to the ground, as good as nothing.
    for (const int size : g.sizes)
      blocks.push_back({.size = size, .chooses = trial % 2 == 1 && random() > 0.0});
    const std::vector<int> order = BlockLdlt::elimination_order(blocks, g.edges);
    const auto rank = [&](int block) {
      return std::find(order.begin(), order.end(), block) - order.begin();
    };
    for (const auto& [a, b] : g.edges) blocks[rank(a) < rank(b) ? a : b].inner += 2;
    BlockLdlt sparse(blocks, g.edges);
    const int n = sparse.unknowns();
    sparse.set_zero();
    MatX dense = MatX::Zero(n, n);
    const auto add = [&](int a, int i, int b, int j, double x) {
      const int r = sparse.offset(a) + i, c = sparse.offset(b) + j;
      dense(r, c) += x;
      if (r != c) dense(c, r) += x;
      sparse.add(a, i, b, j, x);
    };
    for (int k = 0; k < count; ++k) {
      const MatX mass = random_spd(random, g.sizes[k]);
      for (int i = 0; i < g.sizes[k]; ++i)
        for (int j = 0; j <= i; ++j)
          add(k, i, k, j, blocks[k].chooses ? (i == j ? 1e-6 : 0.0) : mass(i, j));
    }
    std::vector<int> at = g.sizes;
    for (const auto& [a, b] : g.edges) {
      const int home = rank(a) < rank(b) ? a : b, other = home == a ? b : a;
      for (int r = 0; r < 2; ++r, ++at[home]) {
        add(home, at[home], home, at[home], -1e-5);
        for (int j = 0; j < g.sizes[home]; ++j) add(home, at[home], home, j, random());
        for (int j = 0; j < g.sizes[other]; ++j) add(home, at[home], other, j, random());
      }
    }
    VecX x = random.vector(n);
    const VecX b = x;
    ASSERT_EQ(sparse.factorize(), -1) << trial;
    sparse.solve(x);
    EXPECT_LT((dense * x - b).norm(), 1e-9 * dense.norm() * x.norm()) << trial;
    const VecX expected = dense.fullPivLu().solve(b);
    EXPECT_LT((x - expected).norm(), 1e-6 * expected.norm()) << trial;
  }
}

TEST(BlockLdlt, ChainHasNoFillAndNamesTheUnknown) {
  const int blocks = 50, size = 3;
  std::vector<int> sizes(blocks, size);
  std::vector<std::pair<int, int>> edges;
  for (int k = 1; k < blocks; ++k) edges.emplace_back(k - 1, k);
  BlockLdlt m(sizes, edges);
  Eigen::Index columns = 0;  // each front holds its block and the next one, the last only itself
  for (int k = 0; k < blocks; ++k) columns += m.front(k).cols();
  EXPECT_EQ(columns, (blocks - 1) * 2 * size + size);
  m.set_zero();
  for (int k = 0; k < blocks; ++k)
    for (int i = 0; i < size; ++i) m.add(k, i, k, i, k == 20 && i == 1 ? 0.0 : 1.0);
  EXPECT_EQ(m.factorize(), 20 * size + 1);
}

}  // namespace
}  // namespace floatframe::test
