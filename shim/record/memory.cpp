#include "shim/record/memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>

#include "shim/record/record.h"

namespace glcast::record {
namespace {

constinit std::atomic<std::size_t> limit{SIZE_MAX}, used{0};

constexpr std::size_t smallest_mapping = 64 * 1024, page = 4096;

bool is_mapped(std::size_t capacity) { return capacity >= smallest_mapping; }

/// Mappings that the next frame will want again: a fresh one costs a fault a page, a tenth of what it takes
/// to fill it.
class Spare {
  public:
    std::byte* take(std::size_t bytes) {
        const std::lock_guard lock(mutex);
        for (Kept& one : kept)
            if (one.bytes == bytes) return one.bytes = 0, std::exchange(one.at, nullptr);
        return nullptr;
    }
    bool keep(std::byte* at, std::size_t bytes) {
        if (bytes > largest) return false;
        const std::lock_guard lock(mutex);
        for (Kept& one : kept)
            if (!one.at) return one = {at, bytes}, true;
        return false;
    }
    void give_back() {
        const std::lock_guard lock(mutex);
        for (Kept& one : kept)
            if (one.at) munmap(one.at, one.bytes), one = {};
    }

  private:
    struct Kept {
        std::byte* at = nullptr;
        std::size_t bytes = 0;
    };
    static constexpr std::size_t largest = 1 << 20; ///< so it keeps 8 MiB at most
    std::mutex mutex;
    Kept kept[8];
};
constinit Spare spare;

std::byte* allocate(std::size_t bytes) {
    if (!is_mapped(bytes)) return static_cast<std::byte*>(std::malloc(bytes));
    if (std::byte* kept = spare.take(bytes)) return kept;
    void* at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return at == MAP_FAILED ? nullptr : static_cast<std::byte*>(at);
}

} // namespace

void set_memory_limit(std::size_t bytes) { limit = bytes; }

void give_back_spare_memory() { spare.give_back(); }

Charge::Charge(std::size_t bytes) : taken(bytes) {
    const std::size_t before = used.fetch_add(bytes, std::memory_order_relaxed);
    const std::size_t most = limit.load(std::memory_order_relaxed);
    if (before <= most && bytes <= most - before) return;
    used.fetch_sub(bytes, std::memory_order_relaxed);
    taken = 0;
    throw std::bad_alloc();
}

Charge::~Charge() {
    if (taken) used.fetch_sub(taken, std::memory_order_relaxed);
}

void Charge::lower(std::size_t to) {
    used.fetch_sub(taken - to, std::memory_order_relaxed);
    taken = to;
}

Block::Block(std::size_t capacity) : charge(capacity) {
    at = allocate(capacity);
    if (!at) throw std::bad_alloc();
}

Block::~Block() {
    if (!is_mapped(capacity()))
        std::free(at);
    else if (!spare.keep(at, capacity()))
        munmap(at, capacity());
}

/// A mapping is cut at a page's end, and stays one.
void Block::shrink(std::size_t bytes) {
    if (is_mapped(capacity())) {
        const std::size_t kept = std::max((bytes + page - 1) / page * page, smallest_mapping);
        const std::size_t mapped = (capacity() + page - 1) / page * page;
        if (kept >= mapped) return;
        munmap(at + kept, mapped - kept);
        return charge.lower(kept);
    }
    auto* smaller = static_cast<std::byte*>(std::realloc(at, std::max<std::size_t>(bytes, 1)));
    if (!smaller) return;
    at = smaller;
    charge.lower(std::max<std::size_t>(bytes, 1));
}

} // namespace glcast::record
