// Runs a fuzz target without libFuzzer: all files of its corpus, then mutations of them in a fixed random order.
//   fuzz_NAME FOLDER [mutations [seed]]
// An input that ends the program or takes too long is left in NAME.failed of the working folder.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz_target.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int most_seconds = 20;                     // of CPU time, for one input
constexpr rlim_t most_memory = 2ull * 1024 * 1024 * 1024;
constexpr std::size_t longest = 16384;               // of a mutation

// What a signal handler can reach.
const Bytes* current = nullptr;
char failed_file[512];

void on_failure(int signal) {
  if (current) {
    const int file = open(failed_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && write(file, current->data(), current->size()) >= 0) close(file);
    const char said[] = "fuzz: the input is left in ";
    [[maybe_unused]] ssize_t told = write(STDERR_FILENO, said, sizeof said - 1);
    told = write(STDERR_FILENO, failed_file, std::strlen(failed_file));
    told = write(STDERR_FILENO, signal == SIGPROF ? "; it took too long\n" : "\n", signal == SIGPROF ? 19 : 1);
  }
  _exit(1);
}

void guard(const char* program) {
  const auto file = std::filesystem::current_path() / std::filesystem::path(program).filename();  // a target may change the folder
  std::snprintf(failed_file, sizeof failed_file, "%s.failed", file.c_str());
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPROF}) std::signal(number, on_failure);
#ifndef __SANITIZE_ADDRESS__
  const rlimit bound{most_memory, most_memory};
  setrlimit(RLIMIT_DATA, &bound);
#endif
}

void run(const Bytes& input) {
  current = &input;
  const itimerval allowed{{0, 0}, {most_seconds, 0}};
  setitimer(ITIMER_PROF, &allowed, nullptr);
  LLVMFuzzerTestOneInput(input.data(), input.size());
  current = nullptr;
}

std::vector<Bytes> corpus_of(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014). The same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<std::size_t>((z ^ (z >> 31)) % n);
  }

 private:
  std::uint64_t state_;
};

/// A piece of another input, or a number as texts of every kind break over.
Bytes piece(const std::vector<Bytes>& corpus, Random& random) {
  static const char* const texts[] = {"0", "-1", "1e999", "nan", "-inf", "1e-320", "4294967296", "9223372036854775808", "0x1p70", "\n",
                                      "\"", "{", "}", "[", "]", "<", ">", "&#0;", "..", "\\"};
  if (random.below(2)) {
    const char* text = texts[random.below(std::size(texts))];
    return Bytes(text, text + std::strlen(text));
  }
  const Bytes& other = corpus[random.below(corpus.size())];
  if (other.empty()) return {};
  const std::size_t from = random.below(other.size()), count = 1 + random.below(std::min<std::size_t>(64, other.size() - from));
  return Bytes(other.begin() + from, other.begin() + from + count);
}

void mutate(Bytes& input, const std::vector<Bytes>& corpus, Random& random) {
  const std::size_t at = random.below(input.size() + 1);
  const auto here = input.begin() + static_cast<std::ptrdiff_t>(at);
  const std::size_t rest = input.size() - at;
  switch (random.below(6)) {
    case 0:
      if (rest) input[at] ^= static_cast<std::uint8_t>(1u << random.below(8));
      break;
    case 1:
      if (rest) input[at] = static_cast<std::uint8_t>(random.below(256));
      break;
    case 2:
      if (rest) input.erase(here, here + static_cast<std::ptrdiff_t>(1 + random.below(std::min<std::size_t>(rest, 32))));
      break;
    case 3:
      input.resize(at);  // truncated
      break;
    default: {
      const Bytes added = piece(corpus, random);
      const std::size_t over = random.below(2) ? std::min(rest, added.size()) : 0;  // in place of what is there, or before it
      input.erase(here, here + static_cast<std::ptrdiff_t>(over));
      input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), added.begin(), added.end());
    }
  }
  if (input.size() > longest) input.resize(longest);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [mutations [seed]]\n", argv[0]);
    return 2;
  }
  guard(argv[0]);
  const std::vector<Bytes> corpus = corpus_of(argv[1]);
  for (const Bytes& input : corpus) run(input);
  const long mutations = argc > 2 && !corpus.empty() ? std::atol(argv[2]) : 0;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  Random random(seed);
  for (long k = 0; k < mutations; ++k) {
    Bytes input = corpus[random.below(corpus.size())];
    for (std::size_t changes = 1 + random.below(4); changes > 0; --changes) mutate(input, corpus, random);
    run(input);
  }
  std::printf("%zu files, %ld mutations with seed %llu\n", corpus.size(), mutations, static_cast<unsigned long long>(seed));
  return corpus.empty() ? 1 : 0;
}
