// SID_FEM text from its blocks: one item per line, D exponents, zeros left out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/sid/sid_content.hpp"

namespace floatframe {
namespace {

using Out = fmt::memory_buffer;

void line(Out& out, int indent, const std::string& key, const std::string& value) {
  fmt::format_to(std::back_inserter(out), "{:{}}{:<{}}= {}\n", "", indent, key, 48 - indent, value);
}

std::string real(double x, const char* block) {
  if (!std::isfinite(x))
    throw InputError(
        ErrorCode::not_finite,
        fmt::format("block {} holds a number that is not finite; a SID file cannot hold it",
                    block));
  std::string text = fmt::format("{:23.16E}", x);
  std::replace(text.begin(), text.end(), 'E', 'D');
  return text;
}

/// 0 zero, 1 diagonal, 2 symmetric, 3 full, 4 unit matrix.
int structure_of(const SidTaylor& t) {
  const MatX& m = t.m0;
  if (t.first_order()) return 3;
  if (m.size() == 0 || m.isZero(0.0)) return 0;
  if (m.rows() != m.cols()) return 3;
  if (m == MatX::Identity(m.rows(), m.cols())) return 4;
  if (m == MatX(m.diagonal().asDiagonal())) return 1;
  return m == m.transpose() ? 2 : 3;
}

void block(Out& out, int indent, const char* name, const SidTaylor& t, int modes) {
  fmt::format_to(std::back_inserter(out), "{:{}}{}\n", "", indent, name);
  const int inner = 26, structure = structure_of(t);
  const std::pair<const char*, Eigen::Index> head[] = {{"order", t.m1.empty() ? 0 : 1},
                                                       {"nrow", t.m0.rows()},
                                                       {"ncol", t.m0.cols()},
                                                       {"nq", modes},
                                                       {"nqn", 0},
                                                       {"structure", structure}};
  for (const auto& [key, value] : head) line(out, inner, key, fmt::format("{:4}", value));
  if (structure != 0 && structure != 4) {
    const auto entry = [&](const std::string& key, double value) {
      if (value != 0.0) line(out, inner, key, real(value, name));
    };
    for (Eigen::Index r = 0; r < t.m0.rows(); ++r)
      for (Eigen::Index c = 0; c < t.m0.cols(); ++c)
        entry(fmt::format("m0({:2},{:2})", r + 1, c + 1), t.m0(r, c));
    for (Eigen::Index c = 0; c < t.m0.cols(); ++c)
      for (Eigen::Index r = 0; r < t.m0.rows(); ++r)
        for (std::size_t q = 0; q < t.m1.size(); ++q)
          entry(fmt::format("m1({:2},{:2},{:2})", r + 1, q + 1, c + 1), t.m1[q](r, c));
  }
  fmt::format_to(std::back_inserter(out), "{:{}}end {}\n", "", indent, name);
}

void frames(Out& out, const SidContent& c) {
  const auto put = [&out](const char* text) {
    fmt::format_to(std::back_inserter(out), "{}\n", text);
  };
  put("           frame");
  for (const SidFrame& f : c.frames) {
    line(out, 16, "new node", f.node);
    line(out, 21, "rframe", "body ref");
    for (const auto& b : sid_frame_blocks) block(out, 21, b.name, f.*b.block, c.modes);
    put("                end node");
  }
  put("           end frame");
}

}  // namespace

std::string sid_text(const SidContent& c) {
  Out out;
  std::string comment = c.comment;
  std::replace_if(
      comment.begin(), comment.end(), [](unsigned char ch) { return ch < 32; }, ' ');
  fmt::format_to(std::back_inserter(out), "{:5}{:4}    :No. nodes, No. modes: {}\n part\n",
                 c.frames.size(), c.modes, comment);
  line(out, 6, "new modal", "");
  fmt::format_to(std::back_inserter(out), "           refmod\n");
  line(out, 16, "mass", real(c.mass, "refmod"));
  line(out, 16, "nelastq", fmt::format("{:4}", c.modes));
  for (std::size_t k = 0; k < c.mode_names.size(); ++k)
    line(out, 16, fmt::format("ielastq ({:4})", k + 1), c.mode_names[k]);
  fmt::format_to(std::back_inserter(out), "           end refmod\n");
  frames(out, c);
  for (const auto& b : sid_modal_blocks) block(out, 11, b.name, c.*b.block, c.modes);
  fmt::format_to(std::back_inserter(out), "      end modal\n end part\n");
  return fmt::to_string(out);
}

std::string write_sid(const FlexibleBody& body, const std::string& comment) {
  SidContent content = sid_content(body);
  content.comment = comment + content.comment;
  return sid_text(content);
}

}  // namespace floatframe
