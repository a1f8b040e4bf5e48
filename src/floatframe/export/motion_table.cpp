#include <fmt/format.h>

#include <iterator>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/export/body_motion.hpp"
#include "floatframe/export/export_file.hpp"

namespace floatframe {
namespace {

class MotionTable : public ExportFile {
 public:
  MotionTable(const ExportBodies& bodies, std::string path)
      : bodies_(bodies), path_(std::move(path)) {
    for (std::size_t i = 0; i < bodies_.bodies.size(); ++i) {
      const Body& body = bodies_.body(i);
      Lines lines{csv_field(body.name), named_nodes(*body.data), {}, {}};
      for (const int n : lines.named)
        lines.names.push_back(csv_field(body.data->nodes[static_cast<std::size_t>(n)].name));
      lines.turns.assign(lines.named.size() + 1, Eigen::Quaterniond::Identity());
      lines_.push_back(std::move(lines));
    }
  }

  void add(const SystemMotion& motion) override {
    ++instants_;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      Lines& l = lines_[i];
      const Body& body = bodies_.body(i);
      const BodyInstant m = body_motion(motion, bodies_.bodies[i]);
      row(motion.t, l.body, "", {m.p, m.v, m.R, m.w, Vec3::Zero()}, l.turns[0]);
      for (std::size_t k = 0; k < l.named.size(); ++k)
        row(motion.t, l.body, l.names[k], node_motion(body, l.named[k], m), l.turns[k + 1]);
    }
  }

  std::string finish() override {
    write_file(path_, text_);
    return fmt::format("{}: {} instants, {} bodies, {} rows", path_, instants_, lines_.size(),
                       rows_);
  }

 private:
  struct Lines {
    std::string body;
    std::vector<int> named;
    std::vector<std::string> names;
    std::vector<Eigen::Quaterniond> turns;  ///< of the previous instant
  };

  void row(double time, const std::string& body, const std::string& node, const NodeMotion& m,
           Eigen::Quaterniond& turn) {
    turn = continued_quaternion(m.R, turn);
    const auto out = std::back_inserter(text_);
    fmt::format_to(out, "{:.17g},{},{}", time, body, node);
    const auto numbers = [&](const auto& values) {
      for (const double x : values) fmt::format_to(out, ",{:.17g}", x);
    };
    numbers(m.p);
    numbers(std::array{turn.w(), turn.x(), turn.y(), turn.z()});
    numbers(m.v);
    numbers(m.w);
    numbers(m.deformation);
    text_ += '\n';
    ++rows_;
  }

  ExportBodies bodies_;
  std::string path_;
  std::vector<Lines> lines_;
  std::string text_ =
      "time [s],body,node,x [m],y [m],z [m],qw,qx,qy,qz,vx [m/s],vy [m/s],vz [m/s],"
      "wx [rad/s],wy [rad/s],wz [rad/s],ux [m],uy [m],uz [m]\n";
  std::size_t instants_ = 0, rows_ = 0;
};

}  // namespace

std::unique_ptr<ExportFile> motion_table(const ExportBodies& bodies, const std::string& path) {
  return std::make_unique<MotionTable>(bodies, path);
}

}  // namespace floatframe
