// Contact pairs: TARGE170 and CONTA17x with the same real constants. Those that are always bonded
// are ties (fe/surface_ties.hpp); those of a pilot node by multipoint constraints (remote points)
// are spiders; all others are nonlinear and treated according to the options.
#include <algorithm>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/decks/face_weights.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/surface_ties.hpp"

namespace floatframe {
namespace {

struct ContactPair {
  std::vector<const AnsysElement*> contacts, targets;
  const AnsysType* contact = nullptr;
  FeSource at;
};

using Corners = std::array<int, 4>;

Corners sorted_corners(const int* nodes, int count) {
  Corners c{-1, -1, -1, -1};
  std::copy_n(nodes, std::min(count, 4), c.begin());
  std::sort(c.begin(), c.end());
  if (c[0] >= 0)  // a triangle has its last corner twice
    for (int k = 1; k < 4; ++k)
      if (c[k] == c[k - 1]) {
        c[k] = -1;
        std::sort(c.begin(), c.end());
        break;
      }
  return c;
}

class ContactBuilder {
 public:
  explicit ContactBuilder(AnsysBuild& build) : b_(build) {}

  void build() {
    for (const AnsysElement& e : b_.content.elements) {
      const auto [type, library] = b_.known(e);
      if (library == nullptr) continue;
      const bool target = library->family == AnsysFamily::target;
      if (!target && library->family != AnsysFamily::contact) continue;
      ContactPair& pair = pairs_[e.real];
      if (pair.at.file < 0) pair.at = e.at;
      (target ? pair.targets : pair.contacts).push_back(&e);
      if (!target) pair.contact = type;
    }
    if (pairs_.empty()) return;
    taken_.assign(b_.model.positions.size(), 0);
    for (const Spider& s : b_.model.spiders)
      for (const int node : s.nodes) taken_[node] = 1;
    // Remote points first: their nodes cannot be tied as well.
    for (const auto& [id, pair] : pairs_)
      if (pilot(pair) >= 0) remote_point(id, pair);
    for (const auto& [id, pair] : pairs_)
      if (pilot(pair) < 0) one(id, pair);
  }

 private:
  static bool bonded(const ContactPair& p) {
    return p.contact != nullptr && (p.contact->keyopt[12] == 5 || p.contact->keyopt[12] == 6);
  }

  std::vector<int> nodes_of(const std::vector<const AnsysElement*>& elements) {
    std::vector<int> all, nodes;
    for (const AnsysElement* e : elements)
      if (b_.nodes_of(*e, nodes)) all.insert(all.end(), nodes.begin(), nodes.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (!all.empty() && all.front() < 0) all.erase(all.begin());
    return all;
  }

  /// The only node of the target, or -1.
  int pilot(const ContactPair& p) {
    if (p.targets.size() != 1) return -1;
    const std::vector<int> nodes = nodes_of(p.targets);
    return nodes.size() == 1 ? nodes[0] : -1;
  }

  /// Contact by multipoint constraints (KEYOPT(2) = 2) with a pilot node. KEYOPT(4): CONTA173 and
  /// 174 spread forces with 1 and are rigid with 2, CONTA175 is rigid with 0 and spreads with 1.
  void remote_point(int id, const ContactPair& p) {
    if (p.contact == nullptr) return;  // a separate node: nothing to hold
    const std::string who = fmt::format("the remote point of real constants {}", id);
    const int behaviour = p.contact->keyopt[4], number = p.contact->number;
    const bool surface = number == 173 || number == 174;
    const bool rigid = surface ? behaviour == 2 : number == 175 && behaviour == 0;
    const bool mean = behaviour == 1 && (surface || number == 175);
    if (p.contact->keyopt[2] != 2 || !bonded(p) || (!rigid && !mean))
      return b_.source.error(
          ErrorCode::unsupported, p.at,
          "{}: {} with KEYOPT(2) = {}, KEYOPT(4) = {}, KEYOPT(12) = {} is not read; multipoint "
          "constraints (2) that are always bonded (5, 6), rigid or spreading forces, are",
          who, ansys_library_element(number)->name, p.contact->keyopt[2], behaviour,
          p.contact->keyopt[12]);
    Spider s;
    s.kind = rigid ? Spider::Kind::rigid : Spider::Kind::mean;
    s.name = who;
    s.reference = pilot(p);
    s.source = p.at;
    std::map<int, double> weights;
    if (mean && surface) weights = area_weights(p);
    for (const int node : nodes_of(p.contacts)) {
      if (node == s.reference || (rigid && taken_[node] != 0)) continue;
      s.nodes.push_back(node);
      if (!weights.empty()) s.weights.push_back(weights[node]);
      if (rigid) taken_[node] = 1;
    }
    b_.note(p.at, "{}: node {} {} {} nodes{}", who, b_.model.node_ids[s.reference],
            rigid ? "holds" : "moves as the mean of", s.nodes.size(),
            rigid     ? ""
            : surface ? ", weighed by their shares of the area of the faces"
                      : ", all of the same weight");
    if (s.nodes.empty()) return;
    b_.model.spiders.push_back(std::move(s));
  }

  /// By node; empty if the faces have no area.
  std::map<int, double> area_weights(const ContactPair& p) {
    std::map<int, double> out;
    double area = 0.0;
    std::vector<int> nodes;
    for (const AnsysElement* e : p.contacts) {
      if (!b_.nodes_of(*e, nodes) || nodes.size() < 3) continue;
      nodes.resize(8, -1);
      const bool triangle = nodes[3] < 0 || nodes[2] == nodes[3];
      std::vector<int> face(nodes.begin(), nodes.begin() + (triangle ? 3 : 4));
      if (std::any_of(face.begin(), face.end(), [](int n) { return n < 0; })) continue;
      const std::size_t corners = face.size();
      std::vector<Vec3> at;
      for (const int n : face) at.push_back(b_.model.positions[n]);
      for (const std::size_t k : {4u, 5u, 6u, 7u})
        if (!triangle || k != 6) face.push_back(nodes[k]);
      const auto absent = std::count(face.begin() + static_cast<int>(corners), face.end(), -1);
      if (absent == static_cast<std::ptrdiff_t>(corners)) face.resize(corners);
      const std::vector<double> shares = face_weights(at, face.size());
      for (std::size_t k = 0; k < face.size(); ++k) {
        area += shares[k];
        if (face[k] >= 0) {
          out[face[k]] += shares[k];
          continue;
        }
        // A straight edge without its mid-side node: its ends have the share.
        out[face[k - corners]] += 0.5 * shares[k];
        out[face[(k - corners + 1) % corners]] += 0.5 * shares[k];
      }
    }
    if (!(area > 0.0)) out.clear();
    return out;
  }

  void one(int id, const ContactPair& p) {
    if (p.contacts.empty()) return;  // a target without contact elements
    const bool always = bonded(p);
    if (!always && b_.options.contact == DeckContact::refuse)
      return b_.source.error(
          ErrorCode::unsupported, p.at,
          "the contact pair of real constants {} is not linear: --contact ignore (key `contact`) "
          "leaves its surfaces free, --contact tied joins them where they touch",
          id);
    if (!always && b_.options.contact == DeckContact::ignore)
      return b_.note(p.at,
                     "the contact pair of real constants {} is ignored, as the options say: its "
                     "surfaces are free",
                     id);
    SurfaceTie tie;
    tie.faces = faces_of(p);
    if (tie.faces.empty())
      return b_.source.error(
          ErrorCode::geometry, p.at,
          "the contact pair of real constants {}: its target lies on no face of a solid or a shell",
          id);
    tie.nodes = nodes_of(p.contacts);
    tie.adjust = false;
    if (!always) tie.distance = b_.options.contact_distance;
    tie.source = p.at;
    taken_.resize(b_.model.positions.size(), 0);
    const TiedNodes done = add_surface_tie(b_.model, tie, taken_);
    std::string text =
        fmt::format("{} pair of real constants {}: {} of {} nodes are tied (within {:.3g})",
                    always ? "bonded" : "contact", id, done.tied,
                    done.tied + static_cast<int>(done.free.size()), done.distance);
    if (!done.free.empty())
      text += fmt::format("; not tied: {}{}", b_.model.node_label(done.free.front()),
                          done.free.size() > 1 ? ", ..." : "");
    b_.note(p.at, "{}", text);
  }

  std::vector<ElementFace> faces_of(const ContactPair& p) {
    if (faces_.empty()) {
      for (std::size_t e = 0; e < b_.model.elements.size(); ++e) {
        const FeElement& element = b_.model.elements[e];
        const auto faces = element_faces(element.type);
        for (std::size_t f = 0; f < faces.size(); ++f) {
          const int count = faces[f].count, corners = count > 4 ? count / 2 : count;
          std::array<int, 4> nodes{};
          for (int k = 0; k < corners; ++k) nodes[k] = element.nodes[faces[f].nodes[k]];
          faces_.try_emplace(sorted_corners(nodes.data(), corners),
                             ElementFace{static_cast<int>(e), static_cast<int>(f)});
        }
      }
    }
    std::vector<ElementFace> found;
    std::vector<int> nodes;
    for (const AnsysElement* e : p.targets) {
      if (!b_.nodes_of(*e, nodes)) continue;
      while (!nodes.empty() && nodes.back() < 0) nodes.pop_back();
      const int count = static_cast<int>(nodes.size()),
                corners = count == 6 ? 3 : std::min(count, 4);
      const auto it = faces_.find(sorted_corners(nodes.data(), corners));
      if (it != faces_.end()) found.push_back(it->second);
    }
    return found;
  }

  AnsysBuild& b_;
  std::map<int, ContactPair> pairs_;
  std::map<Corners, ElementFace> faces_;
  std::vector<char> taken_;
};

}  // namespace

void build_ansys_contact(AnsysBuild& build) { ContactBuilder(build).build(); }

}  // namespace floatframe
