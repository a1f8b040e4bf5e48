// The processes of a study by MPI: the module `libfloatframe_mpi.so`. All calls come from the
// thread that opened it; texts travel as bytes with one tag.
#include <mpi.h>

#include <cstdlib>
#include <stdexcept>

#include "floatframe/sweep/ranks.hpp"

namespace floatframe {
namespace {

constexpr int tag = 1;

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED)
      throw std::runtime_error("this MPI cannot be used by a program with several threads");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const noexcept override { return rank_; }
  int size() const noexcept override { return size_; }

  void send(int to, const std::string& text) override {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
  }

  bool receive(RankMessage& message) override {
    int there = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status);
    if (!there) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    message.from = status.MPI_SOURCE;
    message.text.resize(size);
    MPI_Recv(message.text.data(), size, MPI_BYTE, message.from, tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return true;
  }

  void abort(int exit_code) noexcept override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();
  }

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace
}  // namespace floatframe

extern "C" __attribute__((visibility("default"))) floatframe::Ranks* floatframe_open_ranks() {
  return new floatframe::MpiRanks;
}
