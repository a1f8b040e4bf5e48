// Superelements: DMIG with rows of scalar points, OUTPUT4 as text and binary, stored in three ways;
// the frequencies and the damping of the part against those of the file's matrices.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "floatframe/formats/matrices/op4_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/part.hpp"
#include "support/error_of.hpp"
#include "support/fe_parts.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

enum class Storage { columns, strings, large_strings };

/// First row and length of the runs of a column that are not zero; in columns one from the first to
/// the last.
std::vector<std::pair<int, int>> runs_of(const VecX& x, Storage storage) {
  std::vector<std::pair<int, int>> runs;
  for (int i = 0; i < x.size(); ++i) {
    if (x[i] == 0.0) continue;
    const bool goes_on = !runs.empty() && (storage == Storage::columns ||
                                           runs.back().first + runs.back().second == i);
    if (goes_on)
      runs.back().second = i + 1 - runs.back().first;
    else
      runs.emplace_back(i, 1);
  }
  return runs;
}

std::string op4_text(const std::string& name, const MatX& A, Storage storage) {
  const auto n = A.rows();
  std::string out = fmt::format("{:8}{:8}{:8}{:8}{:<8}1P,3E23.16\n", A.cols(),
                                storage == Storage::large_strings ? -n : n, 6, 2, name);
  const auto values = [&](const VecX& x) {
    for (int i = 0; i < x.size(); ++i)
      out += fmt::format("{:23.16E}{}", x[i], i % 3 == 2 || i + 1 == x.size() ? "\n" : "");
  };
  for (int j = 0; j < A.cols(); ++j) {
    const auto runs = runs_of(A.col(j), storage);
    if (runs.empty()) continue;
    if (storage == Storage::columns) {
      out += fmt::format("{:8}{:8}{:8}\n", j + 1, runs[0].first + 1, runs[0].second);
      values(A.col(j).segment(runs[0].first, runs[0].second));
      continue;
    }
    const bool large = storage == Storage::large_strings;
    int words = 0;
    for (const auto& run : runs) words += 2 * run.second + (large ? 2 : 1);
    out += fmt::format("{:8}{:8}{:8}\n", j + 1, 0, words);
    for (const auto& [first, count] : runs) {
      out += large
                 ? fmt::format("{:8}{:8}\n", 2 * count + 1, first + 1)
                 // Some writers give the number more columns, which it may need.
                 : fmt::format("{:{}}\n", first + 1 + 65536 * (2 * count + 1), j % 2 == 0 ? 8 : 11);
      values(A.col(j).segment(first, count));
    }
  }
  return out + fmt::format("{:8}{:8}{:8}\n{:23.16E}\n", A.cols() + 1, 1, 1, 1.0);
}

/// Words of a record, and the record in one of the two orders of bytes.
class Record {
 public:
  Record& add(int value) { return add_bytes(&value, sizeof value); }
  Record& add(double value) {
    std::uint32_t words[2];
    std::memcpy(words, &value, sizeof value);
    if (swapped_) std::swap(words[0], words[1]);
    return add_bytes(&words[0], 4).add_bytes(&words[1], 4);
  }
  Record& add(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  explicit Record(bool swapped) : swapped_(swapped) {}
  std::string text() {
    Record length(swapped_);
    length.add(static_cast<int>(bytes_.size()));
    return length.bytes_ + bytes_ + length.bytes_;
  }

 private:
  Record& add_bytes(const void* from, std::size_t count) {
    std::string word(count, '\0');
    std::memcpy(word.data(), from, count);
    if (swapped_) std::reverse(word.begin(), word.end());
    bytes_ += word;
    return *this;
  }
  bool swapped_;
  std::string bytes_;
};

std::string op4_binary(const std::string& name, const MatX& A, Storage storage, bool swapped) {
  const int n = static_cast<int>(A.rows());
  const bool large = storage == Storage::large_strings;
  std::string out = Record(swapped)
                        .add(n)
                        .add(large ? -n : n)
                        .add(6)
                        .add(2)
                        .add(fmt::format("{:<8}", name))
                        .text();
  for (int j = 0; j < n; ++j) {
    const auto runs = runs_of(A.col(j), storage);
    if (runs.empty()) continue;
    Record column(swapped);
    int words = 0;
    for (const auto& run : runs) words += 2 * run.second + (large ? 2 : 1);
    const bool whole = storage == Storage::columns;
    column.add(j + 1).add(whole ? runs[0].first + 1 : 0).add(whole ? 2 * runs[0].second : words);
    for (const auto& [first, count] : runs) {
      if (large) column.add(2 * count + 1).add(first + 1);
      if (storage == Storage::strings) column.add(first + 1 + 65536 * (2 * count + 1));
      for (int i = 0; i < count; ++i) column.add(A(first + i, j));
    }
    out += column.text();
  }
  return out + Record(swapped).add(n + 1).add(1).add(2).add(1.0).text();
}

const char* const cards =
    "BEGIN SUPER       10\nGRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nSPOINT,101,THRU,108\n"
    "EXTRN,1,123456,2,123456,101,0,102,0\n,103,0,104,0,105,0,106,0\n,107,0,108,0\n";

FeModel with_modes() { return read_fe_file(fe_data("superelement_with_modes.pch")); }

/// [Hz], those above rigid motions.
VecX frequencies_of(const FeMatrices& m) {
  const SymmetricEigen eig = generalised_eigen(m.K, m.M);
  VecX out = eig.values.tail(eig.values.size() - 6);
  for (double& x : out) x = std::sqrt(x) / (2.0 * std::numbers::pi);
  return out;
}

ReducedPart free_part(FeModel model) {
  to_si(model, *find_unit_system("m-kg-s"));
  PartOptions options;
  options.method = ModeMethod::free_free;
  options.modes = static_cast<int>(model.matrices->dofs.size()) - 6;
  options.stresses = false;
  return reduce_part(model, options);
}

TEST(Superelement, FrequenciesAreThoseOfTheMatrices) {
  for (const char* file : {"superelement_with_modes.pch", "extseout_dmigpch.pch"}) {
    FeModel model = read_fe_file(fe_data(file));
    const VecX expected = frequencies_of(*model.matrices);
    const ReducedPart part = free_part(model);
    ASSERT_EQ(std::ssize(part.health.free_frequencies), expected.size()) << file;
    for (int i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(part.health.free_frequencies[i].reduced, expected[i], 1e-9 * expected[i]) << file;
    EXPECT_EQ(part.health.nodes, 2) << file;
    EXPECT_NEAR(part.body.invariants.m, 94.2, 1e-9) << file;
  }
}

// Craig-Bampton with the file's modes as normal modes: all frequencies again.
TEST(Superelement, ModesOfTheFileAreNormalModes) {
  FeModel model = with_modes();
  const VecX expected = frequencies_of(*model.matrices);
  to_si(model, *find_unit_system("m-kg-s"));
  PartOptions options;
  for (int k = 0; k < 2; ++k) {
    const NodeChoice place = nearest_to(model.positions[k]);
    options.interfaces.push_back(interface_at(k == 0 ? "A" : "B", place));
  }
  options.modes = 8;
  options.stresses = false;
  const ReducedPart part = reduce_part(model, options);
  EXPECT_EQ(part.body.modes(), 14);
  for (const FrequencyPair& pair : part.health.free_frequencies)
    EXPECT_LT(std::abs(pair.relative_error()), 1e-9);
  EXPECT_EQ(count_with(part.health.warnings, "the file has 8 ampl"), 1);
}

TEST(Superelement, Output4InAllItsForms) {
  const TemporaryFolder folder;
  folder.write("arm.pch", cards);
  const FeModel model = with_modes();
  const MatX K = model.matrices->K, M = model.matrices->M, B = 0.3 * M + 1e-5 * K;
  for (const Storage storage : {Storage::columns, Storage::strings, Storage::large_strings}) {
    for (const char* form : {"text", "binary", "swapped"}) {
      const auto one = [&](const char* name, const MatX& A) {
        return form == std::string("text") ? op4_text(name, A, storage)
                                           : op4_binary(name, A, storage, form[0] == 's');
      };
      folder.write("arm.op4", one("KXX", K) + one("MXX", M) + one("BXX1", B) + one("K4XX1", K));
      const FeModel read = read_fe_file(folder / "arm.op4");
      ASSERT_TRUE(read.matrices) << form;
      EXPECT_EQ(MatX(read.matrices->K), K) << form;
      EXPECT_EQ(MatX(read.matrices->M), M) << form;
      EXPECT_EQ(MatX(read.matrices->C), B) << form;
      EXPECT_EQ(read.matrices->scalars, model.matrices->scalars);
      EXPECT_TRUE(contains(read.notes.back(), "ignored: K4XX1"));
    }
  }
}

// C = a M + b K in free modes of mass 1: a + b w^2.
TEST(Superelement, DampingOfTheFile) {
  const TemporaryFolder folder;
  folder.write("arm.pch", cards);
  const FeModel model = with_modes();
  const MatX K = model.matrices->K, M = model.matrices->M, B = 0.3 * M + 1e-5 * K;
  folder.write("arm.op4", op4_text("KAA", K, Storage::columns) +
                              op4_text("MAA", M, Storage::columns) +
                              op4_text("BAA", B, Storage::columns));
  const FeModel read = read_fe_file(folder / "arm.op4");
  const VecX f = frequencies_of(*read.matrices);
  const ReducedPart part = free_part(read);
  for (int i = 0; i < f.size(); ++i) {
    const double expected = 0.3 + 1e-5 * std::pow(2.0 * std::numbers::pi * f[i], 2);
    EXPECT_NEAR(part.body.D(i, i), expected, 1e-8 * expected) << i;
  }
}

// Displacements of a node in a system of its own: the same matrices as in the basic system.
TEST(Superelement, RowsOfTurnedNodes) {
  const std::string system = "CORD2R,7,,0.,0.,0.,0.,1.,0.\n,0.,0.,1.\n";  // z = y, x = z
  Mat3 R;
  R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const FeModel model = with_modes();
  MatX T = MatX::Identity(20, 20);
  T.block<3, 3>(6, 6) = T.block<3, 3>(9, 9) = R;
  const TemporaryFolder folder;
  std::string text = cards;
  text.replace(text.find("GRID,2,,2.,0.,0."), 16, "GRID,2,,2.,0.,0.,7");
  folder.write("arm.pch", text + system);
  folder.write("arm.op4",
               op4_text("KXX", T.transpose() * model.matrices->K * T, Storage::columns) +
                   op4_text("MXX", T.transpose() * model.matrices->M * T, Storage::columns));
  const FeModel read = read_fe_file(folder / "arm.op4");
  const MatX K = model.matrices->K;
  EXPECT_LT((MatX(read.matrices->K) - K).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
  EXPECT_LT((MatX(read.matrices->M) - MatX(model.matrices->M)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Superelement, Errors) {
  const TemporaryFolder folder;
  folder.write("arm.pch", cards);
  const FeModel model = with_modes();
  const MatX K = model.matrices->K, M = model.matrices->M;
  const std::string good =
      op4_text("KXX", K, Storage::columns) + op4_text("MXX", M, Storage::columns);
  const auto error = [&](const std::string& text) {
    folder.write("arm.op4", text);
    return error_of([&] { read_fe_file(folder / "arm.op4", {}, "op4"); });
  };
  const std::string at = (folder / "arm.op4").string();
  ASSERT_EQ(error(good), "no error");
  EXPECT_EQ(error(op4_text("KXX", K, Storage::columns)), at + ": missing");
  EXPECT_EQ(error(op4_text("K1", K, Storage::columns) + op4_text("K2", K, Storage::columns) +
                  op4_text("MXX", M, Storage::columns)),
            at + ": wrong_value");
  EXPECT_EQ(error(op4_text("KXX", K.topLeftCorner(18, 18), Storage::columns) +
                  op4_text("MXX", M.topLeftCorner(18, 18), Storage::columns)),
            (folder / "arm.pch").string() + ": wrong_count");
  EXPECT_EQ(error(good.substr(0, 200)), at + ":2: wrong_count");
  const std::string binary = op4_binary("KXX", K, Storage::strings, false);
  EXPECT_EQ(error(binary.substr(0, 100)), at + ": damaged");
}

// A file that is cut off within the mass: where one amplitude has mass, all have.
TEST(Superelement, MassWithoutItsLastAmplitudes) {
  const TemporaryFolder folder;
  std::string text = read_whole_file(fe_data("superelement_with_modes.pch"));
  const std::size_t last = text.rfind("DMIG*");
  ASSERT_NE(last, std::string::npos);
  ASSERT_TRUE(contains(text.substr(last, 30), "MAAX"));
  folder.write("arm.pch", text.substr(0, last));
  EXPECT_TRUE(contains(error_of([&] { read_fe_file(folder / "arm.pch"); }), "damaged"));
}

TEST(Superelement, CardsThatAreNotReadAreListed) {
  const TemporaryFolder folder;
  const std::string text = read_whole_file(fe_data("superelement_with_modes.pch"));
  EXPECT_EQ(count_with(read_fe_file(fe_data("superelement_with_modes.pch")).notes, "cards"), 0);
  folder.write("arm.pch", text + "CONM2,9,1,,100.\nSPC1,1,123,2\n");
  EXPECT_EQ(count_with(read_fe_file(folder / "arm.pch").notes, "ignored: CONM2 (1), SPC1 (1)"), 1);
}

// A mass that another file replaces is not called ignored.
TEST(Superelement, MatricesOfAnotherFile) {
  const std::string file = fe_data("superelement_with_modes.pch").string();
  FeReadOptions options;
  options.mass = file;
  const FeModel model = read_fe_file(file, options);
  EXPECT_EQ(MatX(model.matrices->M), MatX(with_modes().matrices->M));
  EXPECT_EQ(count_with(model.notes, "MAAX"), 0);
}

// Files that a format does not read are refused, whether they exist or not.
TEST(Superelement, FilesOfOtherFormats) {
  const auto refused = [](const char* file, std::filesystem::path FeReadOptions::*option) {
    FeReadOptions options;
    options.*option = "none.xx";
    return error_of([&] { read_fe_file(fe_data(file), options); }).ends_with(": exclusive");
  };
  EXPECT_TRUE(refused("beam_superelement.op4", &FeReadOptions::mass));
  EXPECT_TRUE(refused("beam_superelement.op4", &FeReadOptions::damping_matrix));
  EXPECT_TRUE(refused("superelement_with_modes.pch", &FeReadOptions::dofs));
}

}  // namespace
}  // namespace floatframe::test
