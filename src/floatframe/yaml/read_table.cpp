#include "floatframe/yaml/read_table.hpp"

#include <cmath>
#include <filesystem>
#include <optional>

#include "floatframe/yaml/csv_file.hpp"

namespace floatframe {
namespace {

/// What is taken of a CSV file.
struct TableChoice {
  std::optional<YamlValue> column, argument;
  double scale = 1.0, offset = 0.0, argument_scale = 1.0;
  DecimalSign sign = DecimalSign::automatic;
};

class TableReader {
 public:
  TableReader(const YamlValue& value, const NumberRule& rule, const char* argument, TableRows& out)
      : value_(value), rule_(rule), argument_(argument), out_(out) {}

  void points(const char* point) {
    out_.good = true;
    out_.file = *value_.context().file;
    out_.path = value_.path();
    std::size_t number = 0;
    for (const YamlValue& item : value_.list()) {
      ++number;
      const auto p = item.numbers(2, 2, rule_, point);
      out_.good = out_.good && p;
      if (p)
        out_.rows.push_back({{(*p)[0], (*p)[1]}, item.mark().line, item.mark().column, number});
    }
  }

  void columns() {
    auto section = value_.section();
    const auto name = section->require("file");
    TableChoice choice;
    choice.column = section->get("column");
    choice.argument = section->get(argument_);
    choice.scale = section->number("scale", any_number(""), 1.0);
    choice.offset = section->number("offset", any_number(""), 0.0);
    const std::string scale = std::string(argument_) + "_scale";
    choice.argument_scale = section->number(scale.c_str(), positive_number(""), 1.0);
    constexpr const char* words[] = {"automatic", "point", "comma"};
    section->word("decimal", words, choice.sign);
    section->finish();
    if (!name) return;
    if (const auto text = name->text("the name of a CSV file")) file(*name, *text, choice);
  }

  void file(const YamlValue& at, const std::string& name, const TableChoice& choice) {
    out_.file = (std::filesystem::path(*value_.context().file).parent_path() / name)
                    .lexically_normal()
                    .string();
    const std::shared_ptr<const CsvFile> csv = parsed(at, choice.sign);
    if (!csv) return;
    out_.good = true;
    if (csv->rows() == 0 && csv->uneven == 0 && !choice.column && !choice.argument) return;
    if (choice.sign == DecimalSign::automatic && csv->separator != ',' && csv->commas &&
        csv->points) {
      at.error(ErrorCode::contradiction,
               "found numbers with decimal points and with commas in '" + out_.file +
                   "', expected one of them; decimal: point or comma says which");
      out_.good = false;
      return;
    }
    const std::size_t none = csv->columns;
    const std::size_t x = choice.argument ? index_of_column(*choice.argument, *csv) : 0;
    std::size_t f = none;
    if (choice.column) {
      f = index_of_column(*choice.column, *csv);
    } else if (csv->columns == 2) {
      f = x == 0 ? 1 : 0;
    } else {
      at.error(ErrorCode::wrong_count, number_of_columns(*csv));
    }
    out_.good = x != none && f != none;
    if (out_.good) take(*csv, x, f, choice);
  }

 private:
  std::shared_ptr<const CsvFile> parsed(const YamlValue& at, DecimalSign sign) {
    CsvFiles own;
    CsvFiles& files = value_.context().tables ? *value_.context().tables : own;
    const std::pair key{out_.file, sign};
    if (const auto known = files.find(key); known != files.end()) return known->second;
    std::string text;
    if (!read_text_file(out_.file, text, *out_.errors, at.mark(), at.path()) ||
        !out_.errors->take_of("characters in all CSV files of tables", text.size(),
                              limits::table_text, at.mark(), at.path()))
      return nullptr;
    return files[key] = std::make_shared<const CsvFile>(parse_csv(std::move(text), sign));
  }

  static std::string list_of(const CsvFile& csv) {
    std::string list;
    for (std::size_t k = 0; k < csv.names.size() && k < 20; ++k)
      list += (k == 0 ? "" : ", ") + csv.names[k].substr(0, 40);
    return csv.names.size() > 20 ? list + ", ..." : list;
  }

  std::string number_of_columns(const CsvFile& csv) const {
    const std::string names = list_of(csv);
    const std::string found = "found " + std::to_string(csv.columns) +
                              (csv.columns == 1 ? " column" : " columns") + " in '" + out_.file +
                              "'" + (names.empty() ? "" : " (" + names + ")");
    if (csv.columns < 2) return found + ", expected two or more";
    return found + ", expected the column to take: {file: " +
           std::filesystem::path(out_.file).filename().string() +
           ", column: " + (csv.names.size() > 1 ? csv.names[1].substr(0, 40) : std::string("2")) +
           "}";
  }

  /// From 0; the number of columns after an error.
  std::size_t index_of_column(const YamlValue& value, const CsvFile& csv) const {
    if (value.looks_like_number()) {
      const auto k = value.integer(1, csv.columns, "the number of a column");
      return k ? *k - 1 : csv.columns;
    }
    const auto name = value.text("the name or the number of a column");
    if (!name) return csv.columns;
    const std::vector<std::size_t> found = csv.columns_of(*name);
    if (found.size() == 1) return found[0];
    if (found.size() > 1)
      value.error(ErrorCode::contradiction, "found '" + *name + "', the name of the columns " +
                                                std::to_string(found[0] + 1) + " and " +
                                                std::to_string(found[1] + 1) + " of '" + out_.file +
                                                "', expected the number of one");
    else if (csv.names.empty())
      value.error(ErrorCode::not_found,
                  "found '" + *name + "', but '" + out_.file +
                      "' has no line of names, expected the number of a column from 1 to " +
                      std::to_string(csv.columns));
    else
      value.not_known("found '" + *name + "', expected one of the columns of '" + out_.file +
                          "': " + list_of(csv),
                      *name, [&] { return csv.names; });
    return csv.columns;
  }

  void take(const CsvFile& csv, std::size_t x, std::size_t f, const TableChoice& choice) {
    for (std::size_t k = 0; k < csv.rows(); ++k) {
      const TableRow place{{}, csv.lines[k], 1, k + 1};
      double point[2] = {0.0, 0.0};
      std::string bad;
      for (const std::size_t column : {x, f}) {
        const double raw = csv.at(k, column);
        double& value = point[column == f ? 1 : 0];
        value = column == f ? choice.scale * raw + choice.offset : choice.argument_scale * raw;
        if (!bad.empty() || rule_.holds(value)) continue;
        bad = std::isnan(raw) ? no_number(csv, k, column)
                              : "found " + number_text(value) + ", expected " + rule_.expectation();
      }
      if (!bad.empty()) {
        out_.error(ErrorCode::out_of_range, place, bad);
        out_.good = false;
        continue;
      }
      if (!out_.errors->take_of("rows in all CSV files of tables", 1, limits::table_rows,
                                value_.mark(), value_.path()))
        return;
      out_.rows.push_back({{point[0], point[1]}, place.line, 1, place.number});
    }
    if (csv.uneven == 0) return;
    out_.error(ErrorCode::wrong_count, {{}, csv.uneven_line, 1, csv.rows() + 1},
               "found " + std::to_string(csv.uneven) + (csv.uneven == 1 ? " column" : " columns") +
                   ", expected " + std::to_string(csv.columns) + " as in the first row");
    out_.good = false;
  }

  static std::string no_number(const CsvFile& csv, std::size_t row, std::size_t column) {
    const std::string cell = csv.cell(row, column);
    const PlainScalar p = classify_plain_scalar(cell);
    return "found '" + cell.substr(0, 40) + "', expected a number with a decimal " +
           (csv.commas ? "comma" : "point") +
           (p.complaint.empty() ? "" : " (" + p.complaint + ")") +
           (row == 0 && csv.names.empty() ? ", or names in all columns of the first line" : "");
  }

  const YamlValue& value_;
  const NumberRule& rule_;
  const char* argument_;
  TableRows& out_;
};

}  // namespace

void TableRows::error(ErrorCode code, const TableRow& row, const std::string& sentence) const {
  const std::string who = path.empty() ? "" : path + "[" + std::to_string(row.number) + "]: ";
  errors->add(code, {file, row.line, row.column}, who + sentence);
}

TableRows read_table_rows(const YamlValue& value, const NumberRule& rule, const char* point,
                          const char* argument) {
  TableRows out;
  out.errors = value.context().errors;
  TableReader reader(value, rule, argument, out);
  const std::string what = std::string("a list of points ") +
                           std::string(point).substr(std::string(point).find('[')) +
                           ", the name of a CSV file or a map with file and column";
  if (value.is_list())
    reader.points(point);
  else if (value.is_map())
    reader.columns();
  else if (const auto name = value.text(what.c_str()))
    reader.file(value, *name, {});
  return out;
}

}  // namespace floatframe
