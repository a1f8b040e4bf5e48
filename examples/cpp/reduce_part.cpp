// From a finite-element mesh to a body with a few modes: the solid A-arm of the Iltis, held at its
// hinge. Prints mass properties, frequencies and invariants, and compares the mass matrix of the
// moving, deformed body by both methods.
//
//   reduce_part examples/iltis_solid/front_arm.msh.gz
#include <cstdio>
#include <floatframe/floatframe.hpp>
#include <stdexcept>

namespace ff = floatframe;

namespace {

ff::InterfaceDescription interface(const char* name, const ff::Vec3& at, unsigned mask) {
  ff::InterfaceDescription i;
  i.name = i.choice.set = name;
  i.at = at;
  i.mask = mask;
  return i;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: reduce_part MESH");
  ff::FeReadOptions reading;  // Gmsh files have no material: steel, in the units of the file
  reading.material = ff::Material{200000, 0.3, 7.85e-9};
  ff::FeModel mesh = ff::read_fe_file(argv[1], reading);
  ff::to_si(mesh, ff::find_unit_system("mm-t-s").value());

  ff::PartOptions options;
  constexpr unsigned all = 63, xyz = 7;
  options.interfaces = {interface("HINGE", {0, 0, 0}, all),
                        interface("BALL", {0, 0.313, -0.073}, xyz),
                        interface("SHOCK", {0.075, 0.241, -0.061}, xyz)};
  options.reference = {ff::BodyReference::Kind::node, "HINGE"};
  options.modes = 4;
  options.check_free_modes = false;
  options.stresses = false;
  options.keep_projection = true;
  const ff::ReducedPart part = ff::reduce_part(mesh, options);

  const ff::InertiaInvariants& v = part.body.invariants;
  const ff::Vec3 c = v.centre_of_mass();
  std::printf("%d nodes, %d modes, mass %.4f kg, centre (%.4f, %.4f, %.4f) m\n", mesh.nodes(),
              part.body.modes(), v.m, c.x(), c.y(), c.z());
  for (const ff::ModeHealth& mode : part.health.normal_modes)
    if (mode.kept) std::printf("%-8s %8.1f Hz\n", mode.name.c_str(), mode.frequency);
  for (int i = 0; i < 3; ++i) std::printf("int X_%c dm of mode 1: %9.6f kg\n", "xyz"[i], v.S(i, 0));

  ff::BodyMotion motion;
  motion.omega = {1.0, 2.0, 3.0};
  motion.y = motion.ydot = ff::VecX::Constant(part.body.modes(), 1e-3);
  const ff::InertiaTerms a = ff::relative_preprocessing(part.body, motion);
  const ff::InertiaTerms b = ff::relative_projection(part.body, motion);
  const double difference = (a.M - b.M).norm() / a.M.norm();
  std::printf("preprocessing and projection: %s\n", difference < 1e-9 ? "agree" : "DIFFER");
  return difference < 1e-9 && (a.Qv - b.Qv).norm() < 1e-9 * a.Qv.norm() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
