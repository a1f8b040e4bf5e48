#include "floatframe/formats/vtk/vtk_file.hpp"

#include <fmt/format.h>

#include <bit>

namespace floatframe {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they lie in memory");

namespace {

template <class T>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

class VtuWriter {
 public:
  std::string write(const VtkGrid& g) {
    xml_ =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
    xml_ += fmt::format(
        "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{:.17g}</DataArray>\n",
        g.time);
    for (const auto& [name, texts] : g.texts) column_of_texts(name, texts);
    xml_ += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        g.points.size() / 3, g.types.size());
    group("PointData", g.point_data);
    group("CellData", g.cell_data);
    xml_ += "<Points>\n";
    array("Points", 3, g.points);
    xml_ += "</Points>\n<Cells>\n";
    array("connectivity", 1, g.connectivity);
    array("offsets", 1, g.offsets);
    array("types", 1, g.types);
    xml_ += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    xml_ += data_;
    xml_ += "\n</AppendedData>\n</VTKFile>\n";
    return std::move(xml_);
  }

 private:
  /// Letters as numbers, each text ended by a zero.
  void column_of_texts(const std::string& name, const std::vector<std::string>& texts) {
    xml_ += fmt::format(
        "<DataArray type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n", name,
        texts.size());
    for (const std::string& text : texts) {
      for (const char c : text)
        xml_ += fmt::format("{} ", static_cast<int>(static_cast<unsigned char>(c)));
      xml_ += "0\n";
    }
    xml_ += "</DataArray>\n";
  }
  void group(const char* tag, const std::vector<VtkArray>& arrays) {
    xml_ += fmt::format("<{}>\n", tag);
    for (const VtkArray& a : arrays)
      std::visit([&](const auto& values) { array(a.name, a.components, values); }, a.values);
    xml_ += fmt::format("</{}>\n", tag);
  }
  template <class T>
  void array(const std::string& name, int components, const std::vector<T>& values) {
    xml_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        vtk_type<T>(), xml_text(name), components, data_.size());
    const std::uint64_t bytes = values.size() * sizeof(T);
    data_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    data_.append(reinterpret_cast<const char*>(values.data()), bytes);
  }

  std::string xml_, data_;
};

}  // namespace

std::string vtu_bytes(const VtkGrid& grid) { return VtuWriter().write(grid); }

std::string pvd_text(const std::vector<std::pair<double, std::string>>& files) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time, name] : files)
    out += fmt::format("<DataSet timestep=\"{:.17g}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time,
                       xml_text(name));
  return out + "</Collection>\n</VTKFile>\n";
}

}  // namespace floatframe
