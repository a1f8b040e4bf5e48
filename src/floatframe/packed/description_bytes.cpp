#include "floatframe/packed/description_bytes.hpp"

#include <algorithm>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/version.hpp"
#include "floatframe/packed/pass_model.hpp"

namespace floatframe {
namespace {

/// As often as a body may refer to the data of an earlier one: what is read remains a multiple of
/// the bytes.
constexpr int most_shares = 16;

/// The data of an earlier body, or its own.
struct BodyData {
  std::vector<std::byte> bytes;
  int shares = 0;
};

/// Place of equal data; as many as there are: they are new.
std::size_t shared_data(std::vector<BodyData>& known, const std::vector<std::byte>& bytes) {
  for (std::size_t k = 0; k < known.size(); ++k)
    if (known[k].bytes == bytes && known[k].shares < most_shares) {
      ++known[k].shares;
      return k;
    }
  known.push_back({bytes, 0});
  return known.size() - 1;
}

template <class S>
void pass_frames(S& s, BodyDescription& b) {
  all(s, b.mirror, b.X_WT);
}

void write_bodies(ByteWriter& s, ModelDescription& d) {
  std::vector<BodyData> known;
  for (BodyDescription& b : d.bodies) {
    pass_frames(s, b);
    if (auto* rigid = std::get_if<RigidDescription>(&b.kind)) {
      pass(s, rigid->shape);
      continue;
    }
    bool reduced = std::holds_alternative<FlexibleBody>(b.kind);
    ByteWriter data;
    if (reduced)
      pass(data, std::get<FlexibleBody>(b.kind));
    else
      pass(data, std::get<FlexibleDescription>(b.kind));
    pass(s, reduced);
    const std::size_t before = known.size(), k = shared_data(known, data.bytes);
    s.whole(k);
    if (k < before) continue;
    for (const std::uint32_t offset : data.doubles)
      s.doubles.push_back(std::uint32_t(s.bytes.size()) + offset);
    s.bytes.insert(s.bytes.end(), data.bytes.begin(), data.bytes.end());
    s.forget();
  }
}

void read_bodies(ByteReader& s, ModelDescription& d) {
  std::vector<std::pair<std::size_t, int>> known;  // body that has them first, shares
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    BodyDescription& b = d.bodies[i];
    pass_frames(s, b);
    if (auto* rigid = std::get_if<RigidDescription>(&b.kind)) {
      pass(s, rigid->shape);
      if (rigid->shape)
        if (const char* what = shape_damage(*rigid->shape, 0, 0)) s.damaged(what);
      continue;
    }
    bool reduced = false;
    pass(s, reduced);
    s.require(reduced, "a body that is not reduced");
    const std::size_t k = s.whole();
    s.require(k <= known.size(), "a body like one that does not exist");
    if (k < known.size()) {
      s.require(++known[k].second <= most_shares, "too many bodies alike");
      b.kind = std::get<FlexibleBody>(d.bodies[known[k].first].kind);
      continue;
    }
    s.forget();  // each has its own texts
    pass(s, std::get<FlexibleBody>(b.kind));
    s.forget();
    known.emplace_back(i, 0);
  }
}

}  // namespace

DescriptionBytes description_bytes(const ModelDescription& description) {
  // A writer passes the same functions as a reader, but changes nothing.
  auto& d = const_cast<ModelDescription&>(description);
  ByteWriter s;
  pass(s, d);
  DescriptionBytes out;
  out.bodies = std::uint32_t(s.bytes.size());
  s.forget();
  write_bodies(s, d);
  if (s.bytes.size() > 0xffffffffu)
    throw InputError(ErrorCode::too_large,
                     "found a model of more than 4 GiB, expected a smaller one to be packed");
  out.bytes = std::move(s.bytes);
  out.doubles = std::move(s.doubles);
  return out;
}

ModelDescription description_of(std::span<const std::byte> bytes) {
  ByteReader s(bytes);
  ModelDescription d;
  pass(s, d);
  s.forget();
  read_bodies(s, d);
  s.require(s.at_end(), "it goes on behind its end");
  return d;
}

namespace {

std::uint64_t layout_of_keys() {
  ContentHash hash;
  hash.add(std::string_view(FLOATFRAME_VERSION));
  for (const ElementType type : element_types) {
    hash.add(std::string_view(element_type_name(type)));
    for (const ElementKey& key : element_keys(type)) {
      hash.add(std::string_view(key.name)).add(std::uint64_t(key.member.read != nullptr));
      for (const char* one : key.words) hash.add(std::string_view(one));
    }
  }
  for (const char* one : joint_words) hash.add(std::string_view(one));
  for (const char* one : output_words) hash.add(std::string_view(one));
  return std::stoull(hash.text().substr(16), nullptr, 16);
}

}  // namespace

std::uint64_t description_layout() {
  static const std::uint64_t layout = layout_of_keys();
  return layout;
}

}  // namespace floatframe
