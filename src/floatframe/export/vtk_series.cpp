#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/export/export_file.hpp"
#include "floatframe/export/motion_grid.hpp"

namespace floatframe {
namespace {

constexpr const char* series_name = "motion";

std::string file_of_series(std::size_t k) { return fmt::format("{}_{:06}.vtu", series_name, k); }

bool is_grid_of_series(const std::string& name) {
  const std::string begin = std::string(series_name) + "_", end = ".vtu";
  if (name.size() < begin.size() + end.size() + 6 || !name.starts_with(begin) ||
      !name.ends_with(end))
    return false;
  return name.find_first_not_of("0123456789", begin.size()) == name.size() - end.size();
}

class VtkSeries : public ExportFile {
 public:
  VtkSeries(const ExportBodies& bodies, std::string folder)
      : folder_(std::move(folder)), grid_(bodies) {
    make_output_folder(folder_);
    remove_file(path(std::string(series_name) + ".pvd"));
  }

  void add(const SystemMotion& motion) override {
    const std::string name = file_of_series(files_.size());
    write_file(path(name), vtu_bytes(grid_.at(motion)), Flush::later);
    files_.emplace_back(motion.t, name);
  }

  std::string finish() override {
    std::set<std::string> written;
    for (const auto& [time, name] : files_) written.insert(name);
    std::error_code ignored;
    std::vector<std::string> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
      const std::string name = entry.path().filename().string();
      if (is_grid_of_series(name) && !written.contains(name)) old.push_back(name);
    }
    for (const std::string& name : old) remove_file(path(name));
    flush_files(folder_);
    const std::string pvd = path(std::string(series_name) + ".pvd");
    write_file(pvd, pvd_text(files_));
    return fmt::format("{}: {} instants, {} bodies, {} points", pvd, files_.size(), grid_.bodies(),
                       grid_.points());
  }

 private:
  std::string path(const std::string& name) const {
    return (std::filesystem::path(folder_) / name).string();
  }

  std::string folder_;
  MotionGrid grid_;
  std::vector<std::pair<double, std::string>> files_;
};

}  // namespace

bool is_file_of_series(const std::string& name) {
  return name == std::string(series_name) + ".pvd" || is_grid_of_series(name);
}

std::unique_ptr<ExportFile> vtk_series(const ExportBodies& bodies, const std::string& folder) {
  return std::make_unique<VtkSeries>(bodies, folder);
}

}  // namespace floatframe
