#include "floatframe/model_file/linear_file.hpp"

#include <algorithm>
#include <tuple>

#include "floatframe/description/sentences.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/formats/matlab/mat_read.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

constexpr const char* linear_matrices[] = {"A", "B", "C", "D"};

bool is_of_linear_system(std::string_view name) {
  return name == "inputs" || name == "outputs" || std::ranges::count(linear_matrices, name) > 0;
}

/// One number or a list is a row.
MatX matrix_of(const NpyArray& array) {
  const std::vector<std::size_t>& shape = array.shape;
  if (shape.size() > 2)
    throw InputError(ErrorCode::wrong_count,
                     "found the shape " + shape_text(shape) + ", expected a matrix");
  const Eigen::Index rows = shape.size() == 2 ? shape[0] : 1,
                     columns = shape.empty() ? 1 : shape.back();
  MatX M(rows, columns);
  std::visit(
      [&](const auto& values) {
        for (Eigen::Index i = 0; i < rows; ++i)
          for (Eigen::Index j = 0; j < columns; ++j)
            M(i, j) = static_cast<double>(values[i * columns + j]);
      },
      array.values);
  return M;
}

std::vector<MatVariable> variables_of_npz(const std::string& bytes, const std::string& file) {
  std::vector<MatVariable> all;
  for (const ZipMember& member : read_zip(bytes, file)) {
    const std::string name = member.name.substr(0, member.name.rfind(".npy"));
    if (!is_of_linear_system(name)) continue;
    if (name.size() > 1)
      all.push_back({name, read_npy_texts(member.content)});
    else
      all.push_back({name, matrix_of(read_npy(member.content))});
  }
  return all;
}

/// Empty if it is one.
std::string complaint_of(const std::vector<MatVariable>& all) {
  const auto find = [&](std::string_view name) {
    return std::find_if(all.begin(), all.end(),
                        [&](const MatVariable& v) { return v.name == name; });
  };
  for (const char* name : linear_matrices) {
    const auto it = find(name);
    if (it == all.end() && *name != 'D')
      return std::string("found no matrix ") + name + ", expected A, B, C and D";
    if (it != all.end() && !std::holds_alternative<MatX>(it->value))
      return std::string("found texts in ") + name + ", expected numbers";
    if (it != all.end() && !std::get<MatX>(it->value).allFinite())
      return std::string("found a number in ") + name + " that is not finite";
  }
  const auto matrix = [&](const char* name) { return std::get<MatX>(find(name)->value); };
  const MatX A = matrix("A"), B = matrix("B"), C = matrix("C");
  const MatX D = find("D") == all.end() ? MatX(C.rows(), B.cols()) : matrix("D");
  if (A.rows() != A.cols() || B.rows() != A.rows() || C.cols() != A.rows() ||
      D.rows() != C.rows() || D.cols() != B.cols() || C.rows() == 0 || B.cols() == 0)
    return "found matrices that do not fit each other, expected A n x n, B n x m, C p x n, D p x m";
  for (const auto& [name, of, columns] :
       {std::tuple("inputs", "B", true), std::tuple("outputs", "C", false)}) {
    const auto names = find(name);
    if (names == all.end()) continue;
    const auto* texts = std::get_if<std::vector<std::string>>(&names->value);
    const Eigen::Index count = columns ? B.cols() : C.rows();
    if (!texts || std::ssize(*texts) != count)
      return "found " + (texts ? std::to_string(texts->size()) + " names in '" : "numbers in '") +
             name + "', expected " + std::to_string(count) + " names, as " + of + " has " +
             (columns ? "columns" : "rows");
  }
  return "";
}

/// A, B, C are there.
std::optional<std::vector<MatVariable>> read_linear_file(const ModelInstance& self,
                                                         const YamlValue& value) {
  const auto name = value.text("the name of a file");
  if (!name) return std::nullopt;
  const std::string file = sibling_path(self, *name);
  std::string bytes;
  if (!read_text_file(file, bytes, *self.context.errors, value.mark(), value.path()))
    return std::nullopt;
  const auto fail = [&](ErrorCode code, const std::string& why) {
    value.error(code, "'" + file + "': " + why);
    return std::nullopt;
  };
  try {
    const bool npz = bytes.starts_with("PK");
    if (!npz && !bytes.starts_with("MATLAB"))
      return fail(ErrorCode::wrong_file,
                  "found neither an .npz nor a .mat file, expected one of `floatframe linearize`");
    std::vector<MatVariable> all = npz ? variables_of_npz(bytes, "") : read_mat(bytes);
    std::erase_if(all, [](const MatVariable& v) { return !is_of_linear_system(v.name); });
    if (const std::string why = complaint_of(all); !why.empty())
      return fail(ErrorCode::wrong_file, why);
    return all;
  } catch (const InputError& e) {
    return fail(e.errors().front().code, e.errors().front().message);
  }
}

}  // namespace

std::vector<std::string> take_linear_file(const ModelInstance& self, const YamlValue& value,
                                          const YamlSection& section, ElementDescription& element) {
  std::vector<std::string> inputs;
  for (const char* key : {"A", "B", "C", "D", "outputs"}) {
    if (!section.has(key)) continue;
    value.error(ErrorCode::exclusive, sentences::excludes(key));
    return inputs;
  }
  const auto file = read_linear_file(self, value);
  if (!file) return inputs;
  const ElementView view(element);
  for (const MatVariable& v : *file)
    for (Eigen::Index k = 1; v.name == "B" && k <= std::get<MatX>(v.value).cols(); ++k)
      inputs.push_back(std::to_string(k));
  for (const MatVariable& v : *file) {
    if (v.name == "inputs")
      inputs = std::get<std::vector<std::string>>(v.value);
    else
      std::visit([&](const auto& x) { set_key_value(element, view.key(v.name), x); }, v.value);
  }
  return inputs;
}

bool names_inputs(const YamlValue& value, const std::vector<std::string>& inputs) {
  return value.is_map() &&
         (inputs.size() > 1 || std::ranges::any_of(value.node().entries, [&](const YamlEntry& e) {
            return std::ranges::count(inputs, e.key) > 0;
          }));
}

std::vector<SignalDescription> read_named_signals(const ModelInstance& self, const YamlValue& value,
                                                  const std::vector<std::string>& inputs) {
  std::vector<SignalDescription> all(inputs.size());
  for (const auto& [name, item] : value.named("a map of inputs of the file", true)) {
    const auto it = std::ranges::find(inputs, name);
    if (it == inputs.end())
      item.not_known("found no input of this name in the file", name, [&] { return inputs; });
    else
      all[it - inputs.begin()] = read_signal(self, item, "", Interpolation::linear);
  }
  return all;
}

std::string read_value_name(const YamlValue& value) {
  const auto name = value.parameter();
  return name ? value_text(*name) : std::string();
}

std::optional<std::vector<std::string>> read_names(const YamlValue& value) {
  std::vector<std::string> names;
  for (const YamlValue& item : value.list("a list of names"))
    names.push_back(item.text("a name").value_or(""));
  return value.is_list() ? std::optional(names) : std::nullopt;
}

}  // namespace floatframe
