// The four inertia cells against nodes and modes: preprocessing must not depend on the nodes,
// projection grows linearly.
#include <benchmark/benchmark.h>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {
namespace {

struct Setup {
  FlexibleBody body;
  Vec3 r0{0.3, -0.2, 0.5}, omega{1.0, -2.0, 0.7};
  Mat3 A = rotation_exp(Vec3(0.3, 0.2, -0.4));
  Mat3 Adot = skew(omega) * A;
  VecX y, ydot;

  Setup(int nodes, int modes) {
    BarFrame frame;
    frame.points = {{"a", Vec3::Zero()}, {"b", Vec3(1.0, 0.0, 0.0)}};
    frame.bars.resize(1);
    frame.bars[0] = {"bar",        "a", "b", "", 0.0, nodes - 1, BeamSection::solid_round(0.02),
                     Vec3::UnitZ()};
    frame.material = {2e11, 0.3, 7500.0};
    ReductionOptions options;
    options.basis = MatX::Random(6 * nodes, modes);
    body = reduce(build_bar_frame(frame), options);
    y = 0.01 * VecX::Random(modes);
    ydot = VecX::Random(modes);
  }
};

template <class Call>
void run(benchmark::State& state, int rigid, Call call) {
  const int nodes = static_cast<int>(state.range(0)), modes = static_cast<int>(state.range(1));
  const Setup s(nodes, modes);
  MatX M(rigid + modes, rigid + modes);
  VecX Qv(rigid + modes);
  PreprocessingWorkspace p_work(modes);
  ProjectionWorkspace b_work(*s.body.projection);
  const PreprocessingData data(s.body.invariants);
  for (auto _ : state) {
    call(s, data, p_work, b_work, M, Qv);
    benchmark::DoNotOptimize(M.data());
    benchmark::ClobberMemory();
  }
}

void relative_preprocessing_cell(benchmark::State& state) {
  run(state, 6,
      [](const Setup& s, const PreprocessingData& d, PreprocessingWorkspace& w,
         ProjectionWorkspace&, MatX& M, VecX& Q) {
        relative_preprocessing(d, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), w, M, Q);
      });
}
void absolute_preprocessing_cell(benchmark::State& state) {
  run(state, 12,
      [](const Setup& s, const PreprocessingData& d, PreprocessingWorkspace& w,
         ProjectionWorkspace&, MatX& M,
         VecX& Q) { absolute_preprocessing(d, s.A, s.Adot, s.y.data(), s.ydot.data(), w, M, Q); });
}
void relative_projection_cell(benchmark::State& state) {
  run(state, 6,
      [](const Setup& s, const PreprocessingData&, PreprocessingWorkspace&, ProjectionWorkspace& w,
         MatX& M, VecX& Q) {
        relative_projection(*s.body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), w, M,
                            Q);
      });
}
void absolute_projection_cell(benchmark::State& state) {
  run(state, 12,
      [](const Setup& s, const PreprocessingData&, PreprocessingWorkspace&, ProjectionWorkspace& w,
         MatX& M, VecX& Q) {
        absolute_projection(*s.body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), w, M, Q);
      });
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"nodes", "modes"});
  for (const int nodes : {6, 11, 51, 101, 1001}) b->Args({nodes, 6});
  for (const int modes : {4, 16, 64}) b->Args({101, modes});
}

BENCHMARK(relative_preprocessing_cell)->Apply(sizes);
BENCHMARK(absolute_preprocessing_cell)->Apply(sizes);
BENCHMARK(relative_projection_cell)->Apply(sizes);
BENCHMARK(absolute_projection_cell)->Apply(sizes);

void invariants(benchmark::State& state) {
  const Setup s(static_cast<int>(state.range(0)), 4);
  BarFrame frame;
  frame.points = {{"a", Vec3::Zero()}, {"b", Vec3(1.0, 0.0, 0.0)}};
  frame.bars.resize(1);
  frame.bars[0] = {"bar",
                   "a",
                   "b",
                   "",
                   0.0,
                   static_cast<int>(state.range(0)) - 1,
                   BeamSection::solid_round(0.02),
                   Vec3::UnitZ()};
  frame.material = {2e11, 0.3, 7500.0};
  const FeModel model = build_bar_frame(frame);
  for (auto _ : state)
    benchmark::DoNotOptimize(invariants_isoparametric(model, s.body.projection->X));
}
BENCHMARK(invariants)->Arg(11)->Arg(202)->Arg(1001);

}  // namespace
}  // namespace floatframe
