// Parts: reductions of finite-element files and of meshes, body files, their health reports.
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "views.hpp"

namespace floatframe::python {
namespace {

using FilePtr = std::shared_ptr<BodyFile>;

[[noreturn]] void refuse(const std::string& option, const nb::handle value,
                         const std::string& expected) {
  const auto found = nb::cast<std::string>(nb::repr(value));
  throw InputError(ErrorCode::wrong_value, option + ": found " + found + ", expected " + expected);
}

template <class T>
T need(const std::string& option, const nb::handle value, const std::string& expected) {
  T x{};
  if ((PyBool_Check(value.ptr()) && !std::is_same_v<T, bool>) || !nb::try_cast(value, x))
    refuse(option, value, expected);
  return x;
}

template <class T>
T field(const nb::dict& d, const char* name) {
  return nb::cast<T>(d[name]);
}

Vec3 vector_of(const nb::handle value) {
  const auto [x, y, z] = nb::cast<std::array<double, 3>>(value);
  return {x, y, z};
}

/// A place in the format of places.py: with the keys of model files.
NodeChoice choice_of(const std::string& label, const nb::dict& place) {
  const auto word = field<std::string>(place, "way");
  const auto ways = node_ways();
  const auto way =
      std::find_if(ways.begin(), ways.end(), [&](const NodeWay& w) { return w.word == word; });
  if (way == ways.end())
    throw InputError(ErrorCode::not_found, label + ": unknown way '" + word + "'");
  NodeChoice c;
  c.by = way->by;
  c.tolerance = field<double>(place, "tolerance");
  const auto values = field<nb::dict>(place, "values");
  for (const NodeWayValue& value : way->values) {
    if (!values.contains(value.key)) continue;
    const nb::object x = values[value.key];
    using V = NodeWayValue;
    if (const auto* name = std::get_if<V::Name>(&value.kind))
      c.*name->at = nb::cast<std::string>(x);
    else if (const auto* whole = std::get_if<V::Number>(&value.kind))
      c.*whole->at = nb::cast<int>(x);
    else if (const auto* point = std::get_if<V::Point>(&value.kind))
      c.*point->at = vector_of(x);
    else if (const auto* axis = std::get_if<V::Direction>(&value.kind))
      c.*axis->at = vector_of(x).stableNormalized();
    else
      c.*std::get<V::Length>(value.kind).at = nb::cast<double>(x);
  }
  return c;
}

std::optional<Vec3> reference_point(const nb::dict& place) {
  if (nb::object(place["at"]).is_none()) return std::nullopt;
  return vector_of(place["at"]);
}

void add_places(PartJob& job, const std::string& key, const nb::dict& places) {
  for (const auto& [given, value] : places) {
    const auto name = nb::cast<std::string>(given);
    const std::string label = key + " '" + name + "'";
    const auto place = nb::cast<nb::dict>(value);
    if (key == "markers") {
      job.options.markers.push_back(
          {name, choice_of(label, place), reference_point(place), field<bool>(place, "residual")});
      continue;
    }
    InterfaceDescription i;
    i.name = name;
    i.choice = choice_of(label, place);
    i.at = reference_point(place);
    const auto type = field<std::string>(place, "type");
    const auto tie = std::find(std::begin(tie_words), std::end(tie_words), type);
    if (tie == std::end(tie_words))
      throw InputError(ErrorCode::wrong_value,
                       label + ": type: found '" + type + "', expected " + alternatives(tie_words));
    i.kind = static_cast<Spider::Kind>(tie - std::begin(tie_words));
    const auto dofs = field<std::string>(place, "dofs");
    const auto mask = dofs_of(dofs);
    if (!mask)
      throw InputError(ErrorCode::wrong_value,
                       label + ": dofs: found '" + dofs +
                           "', expected all, or directions such as xyz, x+z or xyz+rz");
    i.mask = *mask;
    job.options.interfaces.push_back(i);
  }
}

/// Sets the job's value of the option `key`.
struct Given {
  using O = PartOption;
  PartJob& job;
  const std::string key;
  const nb::handle value;

  void operator()(const O::Number& o) const {
    const auto x = need<double>(key, value, o.rule.expectation());
    if (const auto complaint = o.rule.complaint(x))
      throw InputError(ErrorCode::out_of_range, key + ": " + *complaint);
    job.options.*o.at = x;
  }
  void operator()(const O::Count& o) const {
    const int n = need<int>(key, value, o.rule.expectation());
    if (const auto complaint = o.rule.complaint(n))
      throw InputError(ErrorCode::out_of_range, key + ": " + *complaint);
    job.options.*o.at = n;
  }
  void operator()(const O::Word& o) const {
    const std::string expected = alternatives(o.words);
    const auto text = need<std::string>(key, value, expected);
    const auto word = std::find(o.words.begin(), o.words.end(), text);
    if (word == o.words.end()) refuse(key, value, expected);
    o.set(job, o.first + static_cast<int>(word - o.words.begin()));
  }
  void operator()(const O::Switch& o) const {
    job.options.*o.at = need<bool>(key, value, "True or False");
  }
  void operator()(const O::File& o) const {
    job.read.*o.at = need<std::string>(key, value, "the path of a file");
  }
  void operator()(const O::Special& o) const {
    if (key == "interfaces" || key == "markers")
      add_places(job, key, nb::cast<nb::dict>(value));
    else if (o.repeated)
      for (const auto& text : need<std::vector<std::string>>(key, value, "a list of texts"))
        o.parse(job, text);
    else
      o.parse(job, need<std::string>(key, value, "text"));
  }
};

/// Options by the keys of model files; None is the same as not given.
PartJob job_of(const std::string& file, const Keywords& options) {
  PartJob job;
  job.file = file;
  for (const PartOption& option : part_options()) {
    if (!options.contains(option.key)) continue;
    const nb::object value = options[option.key];
    if (!value.is_none()) std::visit(Given{job, option.key, value}, option.kind);
  }
  return job;
}

/// Thrown to end a reduction when Python was interrupted.
struct Interrupted {};

/// Queue of the stages of a reduction from its thread to Python.
class StageQueue {
 public:
  void add(const std::string& stage, double seconds) {
    const std::lock_guard lock(mutex_);
    stages_.emplace_back(stage, seconds);
  }
  void report_stages(const nb::object& progress) {
    std::vector<std::pair<std::string, double>> stages;
    {
      const std::lock_guard lock(mutex_);
      stages.swap(stages_);
    }
    if (progress.is_none()) return;
    for (const auto& [stage, seconds] : stages) progress(stage, seconds);
  }

 private:
  std::mutex mutex_;
  std::vector<std::pair<std::string, double>> stages_;
};

/// Errors of algorithms caused by the numbers of a part or a damaged file become input errors.
template <class Work>
auto of_input(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const RunError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(ErrorCode::wrong_file, {name, 0, 0}, error.what());
  } catch (const std::logic_error& error) {
    throw InputError(ErrorCode::damaged, {name, 0, 0},
                     std::string("the file is damaged: ") + error.what());
  }
}

FilePtr reduced(PartJob job, const std::function<BodyFile(const PartJob&)>& reduce,
                const nb::object& progress) {
  std::atomic<bool> stop{false};
  StageQueue stages;
  job.options.progress = [&](const std::string& stage, double seconds) {
    stages.add(stage, seconds);
    if (stop) throw Interrupted{};
  };
  auto content = std::make_shared<BodyFile>();
  interruptible(
      stop, [&] { *content = of_input(job.file, [&] { return reduce(job); }); },
      [&] { stages.report_stages(progress); });
  stages.report_stages(progress);
  return content;
}

FilePtr reduce_file(const std::string& file, const Keywords& options, const nb::object& progress) {
  const PartJob job = job_of(file, options);
  if (job.units.empty()) {
    std::string hint;
    {
      Unlocked released;
      hint = hint_of_units(job);
    }
    std::string known;
    for (const std::string& name : unit_system_names()) known += name + ", ";
    throw InputError(ErrorCode::missing,
                     "units is missing: the file does not state its units; known are " + known +
                         "or any <length>-<mass>-<time>" + hint);
  }
  return reduced(job, reduce_part_file, progress);
}

FilePtr reduce_mesh(const std::shared_ptr<FeModel>& mesh, const std::string& name,
                    const Keywords& options, const nb::object& progress) {
  return reduced(
      job_of(name, options), [&](const PartJob& job) { return reduce_part_model(*mesh, job); },
      progress);
}

nb::bytes bytes_of(const BodyFile& content) {
  std::string bytes;
  {
    Unlocked released;
    bytes = body_file_bytes(content);
  }
  return nb::bytes(bytes.data(), bytes.size());
}

template <std::size_t N>
View<int> cells(const std::vector<std::array<int, N>>& list, const FilePtr& f) {
  return view(list.empty() ? nullptr : list.front().data(), {list.size(), N},
              {static_cast<std::int64_t>(N), 1}, f);
}

Keywords provenance(const BodyFile& f) {
  const Provenance& from = f.provenance;
  Keywords d;
  d["source"] = from.source;
  d["source_hash"] = from.source_hash;
  d["units"] = from.units;
  d["options"] = from.options;
  d["date"] = from.date;
  d["version"] = from.version;
  d["files"] = from.files;
  return d;
}

void bind_functions(nb::module_& m) {
  m.def("reduce_file", reduce_file, nb::arg(), nb::arg(), nb::arg().none());
  m.def("reduce_mesh", reduce_mesh, nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  m.def("reduce_options", [] {
    std::vector<std::string> keys;
    for (const PartOption& option : part_options()) keys.emplace_back(option.key);
    return keys;
  });
  m.def("read_body", [](const std::string& file) {
    Unlocked released;
    return std::make_shared<BodyFile>(of_input(file, [&] { return read_body_file(file); }));
  });
  m.def("read_body_bytes", [](const nb::bytes& bytes, const std::string& name) {
    const std::string_view content(bytes.c_str(), bytes.size());
    return std::make_shared<BodyFile>(
        of_input(name, [&] { return read_body_bytes(content, name); }));
  });
  m.def("part_of_body", [](const std::shared_ptr<FlexibleBody>& body) {
    auto file = std::make_shared<BodyFile>();
    file->part.body = *body;
    file->provenance.source = "floatframe.Body";
    file->provenance.units = "m-kg-s";
    file->provenance.version = version();
    return file;
  });
  m.def("convert_file",
        [](const std::string& file, const std::string& out, int modes, const Keywords& options) {
          const PartJob job = job_of(file, options);
          Unlocked released;
          return of_input(job.file, [&] { return save_converted_mesh(job, out, modes); });
        });
  m.def("file_info", [](const std::string& file, const Keywords& options) {
    const PartJob job = job_of(file, options);
    Unlocked released;
    return std::make_pair(file_info_text(job), file_info_json(job));
  });
}

}  // namespace

void bind_part(nb::module_& m) {
  nb::class_<BodyFile> c(m, "Part");
  def_view(c, "nodes", [](const FilePtr& f) { return points_view(f->part.surface_positions, f); });
  def_view(c, "mode_shapes",
           [](const FilePtr& f) { return shapes_view(f->part.surface_modes, f); });
  def_view(c, "node_indices", [](const FilePtr& f) {
    const std::vector<int>& k = f->part.surface.nodes;
    return view(k.data(), {k.size()}, {1}, f);
  });
  def_view(c, "triangles", [](const FilePtr& f) { return cells(f->part.surface.triangles, f); });
  def_view(c, "lines", [](const FilePtr& f) { return cells(f->part.surface.lines, f); });
  c.def_prop_ro("provenance", provenance);
  c.def_prop_ro("report_text", [](const BodyFile& f) {
    return f.provenance.source + " (" + f.provenance.units + "): " + health_text(f.part.health);
  });
  c.def_prop_ro("report_json", [](const BodyFile& f) { return health_json(f.part.health, 0); });
  c.def("save", [](const BodyFile& f, const std::string& path) {
    Unlocked released;
    write_body_file(path, f);
  });
  c.def("to_bytes", bytes_of);
  c.def("sid_text", [](const BodyFile& f) {
    return write_sid(f.part.body, f.provenance.source + " by Floatframe " + f.provenance.version);
  });
  bind_functions(m);
}

}  // namespace floatframe::python
