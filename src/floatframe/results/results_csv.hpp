#pragma once
// Results as comma-separated values (RFC 4180): one header line `time [s],chassis.z [m],...`, then
// one line per sample. SI units, angles in radians, 17 significant digits, so that every number
// reads back to the same bits.
#include <span>
#include <string>
#include <vector>

#include "floatframe/run/result_table.hpp"

namespace floatframe {

std::string results_csv(const ResultTable& table);

/// The header line; empty without columns.
void append_csv_header(std::string& text, const std::vector<Column>& columns);
/// One line for every `columns` numbers.
void append_csv_rows(std::string& text, std::size_t columns, std::span<const double> numbers);

}  // namespace floatframe
