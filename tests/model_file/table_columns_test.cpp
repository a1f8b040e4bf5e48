// Columns of CSV files by name and number: signs of decimals, units, scales; what is said of files
// that leave open which column is meant.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/yaml/csv_file.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

class TableColumns : public testing::Test {
 protected:
  ModelDescription read(const std::string& csv, const std::string& table,
                        const std::string& spring = "[[0, 0], [1, 1]]") {
    folder_.write("t.csv", csv);
    folder_.write("model.yaml",
                  "floatframe: 1\n"
                  "bodies: {a: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [0, 0, 0]}}\n"
                  "forces:\n"
                  "  f: {type: force, body: a, direction: x, magnitude: {table: " +
                      table +
                      "}}\n"
                      "  s: {type: spring_damper, from: {body: ground, at: [0, 0, 1]}, to: {body: "
                      "a}, spring: {table: " +
                      spring + "}}\n");
    return read_model(folder_.file("model.yaml"));
  }
  /// Of the load at 0, 0.5 and 1 s.
  std::vector<double> values(const std::string& csv, const std::string& table) {
    const ModelDescription d = read(csv, table);
    const PiecewisePolynomial& f = std::get<AppliedForce>(d.forces.at(0).kind).magnitude.pieces;
    return {f(0.0).f, f(0.5).f, f(1.0).f};
  }
  std::string errors(const std::string& csv, const std::string& table) {
    return folder_.without(test::error_of([&] { read(csv, table); }));
  }

  test::TemporaryFolder folder_;
};

using Values = std::vector<double>;

TEST_F(TableColumns, ByNameAndNumber) {
  const std::string csv = "time,F1,F2,F3\n0,1,2,3\n1,4,5,6\n";
  EXPECT_EQ(values(csv, "{file: t.csv, column: F2}"), (Values{2, 3.5, 5}));
  EXPECT_EQ(values(csv, "{file: t.csv, column: 4}"), (Values{3, 4.5, 6}));
  EXPECT_EQ(values(csv, "{file: t.csv, column: F1, scale: 2, offset: 10}"), (Values{12, 15, 18}));
  EXPECT_EQ(values("F,t\n2,0\n4,1\n", "{file: t.csv, time: t}"), (Values{2, 3, 4}));
  EXPECT_EQ(
      values("F,n,t\n2,x,0\n4,y,1000\n", "{file: t.csv, column: 1, time: 3, time_scale: 1e-3}"),
      (Values{2, 3, 4}));
}

TEST_F(TableColumns, NamesWithUnitsQuotesAndBlanks) {
  EXPECT_EQ(values("\"time\",\"force, x\",b\n\"s\",\"N\",\"\"\n0,1,2\n1,3,4\n",
                   "{file: t.csv, column: \"force, x\"}"),
            (Values{1, 2, 3}));
  EXPECT_EQ(values("t [s];F [N];F [kN]\n0;1;2\n1;3;4\n", "{file: t.csv, column: \"F [N]\"}"),
            (Values{1, 2, 3}));
  EXPECT_EQ(values("t [s];F [N];F [kN]\n0;1;2\n1;3;4\n", "{file: t.csv, column: \"F [kN]\"}"),
            (Values{2, 3, 4}));
  EXPECT_EQ(values("t (s)\tforce 1\tF_2\n0\t1\t2\n1\t3\t4\n", "{file: t.csv, column: F_2}"),
            (Values{2, 3, 4}));
  EXPECT_EQ(
      values("t\t\"force #1\"\tF_2\n0\t1\t2\n1\t3\t4\n", "{file: t.csv, column: \"force #1\"}"),
      (Values{1, 2, 3}));
  EXPECT_EQ(values("# run 7\nt;F\ns;N\n\n0;1 # begin\n1;3\n", "t.csv"), (Values{1, 2, 3}));
}

TEST_F(TableColumns, DecimalCommas) {
  EXPECT_EQ(values("t;F\n0,0;1,5\n1;-2,5e1\n", "t.csv"), (Values{1.5, -11.75, -25}));
  EXPECT_EQ(values("t\tF\tG\n0\t1,5\t7\n1\t2,5\t8\n", "{file: t.csv, column: F}"),
            (Values{1.5, 2, 2.5}));
  EXPECT_EQ(values("0 1\n1 2,5\n", "t.csv"), (Values{1, 1.75, 2.5}));
  EXPECT_EQ(values("0,1 2,5\n1,1 3,5\n", "t.csv"), (Values{2.5, 2.9, 3.4}));
  EXPECT_EQ(values("0, 2\n1, 3\n", "t.csv"), (Values{2, 2.5, 3}));  // columns
  EXPECT_EQ(values("0;1,5\n1;2,5\n", "{file: t.csv, decimal: comma}"), (Values{1.5, 2, 2.5}));
  EXPECT_EQ(errors("0;1,5\n1;2,5\n", "{file: t.csv, decimal: point}"),
            "t.csv:1:1: out_of_range\nt.csv:2:1: out_of_range");
  EXPECT_EQ(errors("0;1,5\n1;2.5\n", "t.csv"),
            "model.yaml:4:62: forces.f.magnitude.table: contradiction");
  EXPECT_EQ(errors("0;1,5\n1;1.002,5\n", "{file: t.csv, decimal: comma}"),
            "t.csv:2:1: out_of_range");
}

TEST_F(TableColumns, SpringsAndRoadsHaveThemToo) {
  const ModelDescription d = read("x;k;F\n0;1;-7\n2;1;9\n", "[[0, 0], [1, 1]]",
                                  "{file: t.csv, column: F, x: 1, x_scale: 0.5, offset: -1}");
  const PiecewisePolynomial& f = std::get<SpringDamper>(d.forces.at(1).kind).spring;
  EXPECT_EQ(f(0.0).f, -8.0);
  EXPECT_EQ(f(1.0).f, 8.0);
}

TEST_F(TableColumns, ErrorsSayWhichColumnsThereAre) {
  const std::string csv = "time,Fx,Fy\n0,1,2\n1,4,5\n";
  EXPECT_EQ(errors(csv, "t.csv"), "model.yaml:4:62: forces.f.magnitude.table: wrong_count");
  EXPECT_EQ(errors(csv, "{file: t.csv}"),
            "model.yaml:4:69: forces.f.magnitude.table.file: wrong_count");
  EXPECT_EQ(errors(csv, "{file: t.csv, column: Fz}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: not_found");
  EXPECT_EQ(errors(csv, "{file: t.csv, column: 4}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: out_of_range");
  EXPECT_EQ(errors(csv, "{file: t.csv, column: 0}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: out_of_range");
  EXPECT_EQ(errors(csv, "{file: t.csv, column: Fx, time: tme}"),
            "model.yaml:4:94: forces.f.magnitude.table.time: not_found");
  EXPECT_EQ(errors("0,1,2\n1,4,5\n", "{file: t.csv, column: G}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: not_found");
  EXPECT_EQ(errors(csv, "{file: t.csv, colum: Fx}"),
            "model.yaml:4:69: forces.f.magnitude.table.file: wrong_count\nmodel.yaml:4:76: "
            "forces.f.magnitude.table.colum: unknown_key");
  EXPECT_EQ(errors(csv, "{column: Fx}"), "model.yaml:4:55: forces.f.magnitude.table: missing");
  EXPECT_EQ(errors("t,F,G\n0,1,2\n1,,3\n", "{file: t.csv, column: F}"), "t.csv:3:1: out_of_range");
  EXPECT_EQ(errors("t,F,G\n0,1,2\n1,3\n", "{file: t.csv, column: F}"), "t.csv:3:1: wrong_count");
  EXPECT_EQ(errors("t,F,F\n0,1,2\n1,4,5\n", "{file: t.csv, column: F}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: contradiction");
  EXPECT_EQ(errors("t,F [N],F [kN]\n0,1,2\n1,4,5\n", "{file: t.csv, column: F}"),
            "model.yaml:4:84: forces.f.magnitude.table.column: contradiction");
  EXPECT_EQ(errors("7\n8\n", "t.csv"), "model.yaml:4:62: forces.f.magnitude.table: wrong_count");
}

TEST(CsvFile, IsParsedOnceWhateverItsColumns) {
  const CsvFile csv = parse_csv("\xEF\xBB\xBFtime [s];F\r\ns;N\r\n0;1,5\r\n1;x\r\n", {});
  EXPECT_EQ(csv.names, (std::vector<std::string>{"time [s]", "F"}));
  EXPECT_EQ(csv.rows(), 2u);
  EXPECT_EQ(csv.lines, (std::vector<int>{3, 4}));
  EXPECT_EQ(csv.at(0, 1), 1.5);
  EXPECT_TRUE(std::isnan(csv.at(1, 1)));
  EXPECT_EQ(csv.cell(1, 1), "x");
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(csv.columns_of("time"), Places{0});
  EXPECT_EQ(csv.columns_of("tim"), Places{});
  const CsvFile twice = parse_csv("t,F,F,M [N],M [kN],M\n0,1,2,3,4,5\n", {});
  EXPECT_EQ(twice.columns_of("F"), (Places{1, 2}));
  EXPECT_EQ(twice.columns_of("M"), Places{5});
}

}  // namespace
}  // namespace floatframe
