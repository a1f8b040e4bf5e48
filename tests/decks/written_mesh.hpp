#pragma once
// Models written for other programs and read again.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/fe/fe_system.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/written/mesh_writer.hpp"
#include "floatframe/math/dense.hpp"
#include "support/fe_parts.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {

inline WrittenMesh written(const FeModel& model, const std::string& ending, int modes = 0) {
  return mesh_format_of("part" + ending).write(model, {modes});
}

inline std::string written_notes(const FeModel& model, const std::string& ending) {
  std::string text;
  for (const std::string& note : written(model, ending, 5).notes) text += note + '\n';
  return text;
}

inline FeModel there_and_back(const FeModel& model, const std::string& ending) {
  const TemporaryFolder folder;
  FeReadOptions options;
  if (ending == ".inp") options.dialect = DeckDialect::calculix;
  if (ending == ".msh") options.material = steel;
  return read_fe_file(folder.write("part" + ending, written(model, ending).bytes), options);
}

/// Largest difference relative to the largest entry.
inline double apart(const SparseMatrix& a, const SparseMatrix& b) {
  if (a.rows() != b.rows()) return 1.0;
  const SparseMatrix d = a - b;
  return MatX(d).cwiseAbs().maxCoeff() / MatX(a).cwiseAbs().maxCoeff();
}

inline void expect_same_system(const FeModel& a, const FeModel& b) {
  const FeSystem A = assemble(a, Integration::ccx), B = assemble(b, Integration::ccx);
  EXPECT_LT(apart(A.K, B.K), 1e-11);  // 13 digits
  EXPECT_LT(apart(A.M, B.M), 1e-11);
}

}  // namespace floatframe::test
