// What the fuzzers share: input as a file, one thread, mutators' dice.
#pragma once
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <random>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <tbb/global_control.h>
#include <unistd.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace glcast::fuzz {

/// The bytes as a file in memory that ends in `extension`: readers ask for files, and tell formats by names.
class InputAsFile {
  public:
    explicit InputAsFile(const char* extension)
        : name("/dev/shm/glcast-fuzz-" + std::to_string(getpid()) + extension),
          descriptor(open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {}
    ~InputAsFile() {
        close(descriptor);
        unlink(name.c_str());
    }
    InputAsFile(const InputAsFile&) = delete;
    InputAsFile& operator=(const InputAsFile&) = delete;

    const std::string& put(const std::uint8_t* data, std::size_t size) {
        if (ftruncate(descriptor, 0) != 0 || pwrite(descriptor, data, size, 0) != ssize_t(size)) std::abort();
        return name;
    }

  private:
    std::string name;
    int descriptor;
};

/// Runs are the same however many cores there are, and libFuzzer counts one process as one.
inline void on_one_thread() {
    static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
}

/// libFuzzer's own mutation of a part of the input, which may grow to `most`.
inline void mutate(std::string& part, std::size_t most) {
    const std::size_t size = part.size();
    part.resize(std::max(size, most));
    part.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(part.data()), size, part.size()));
}

/// Puts `text` into the buffer where it fits; else leaves the buffer as it is.
inline std::size_t give(std::string_view text, std::uint8_t* data, std::size_t size, std::size_t max_size) {
    if (text.size() > max_size) return size;
    text.copy(reinterpret_cast<char*>(data), text.size());
    return text.size();
}

using Dice = std::minstd_rand;

} // namespace glcast::fuzz
