// The memory that recordings take: bounded for all of them together, and given back to the system when they
// go.
#pragma once
#include <cstddef>
#include <utility>

namespace glcast::record {

/// So many bytes against the limit (set_memory_limit), for as long as it lives.
class Charge {
  public:
    Charge() = default;
    explicit Charge(std::size_t bytes); ///< throws std::bad_alloc where that would be beyond the limit
    Charge(Charge&& other) noexcept : taken(std::exchange(other.taken, 0)) {}
    Charge& operator=(Charge&& other) noexcept {
        std::swap(taken, other.taken);
        return *this;
    }
    ~Charge();

    std::size_t bytes() const { return taken; }
    void lower(std::size_t to);

  private:
    std::size_t taken = 0;
};

/// Uninitialised memory, aligned to 16, charged. Large blocks are mapped: the program's heap would keep what
/// was freed between its own blocks.
class Block {
  public:
    Block() = default;
    explicit Block(std::size_t capacity); ///< throws std::bad_alloc
    Block(Block&& other) noexcept : at(std::exchange(other.at, nullptr)), charge(std::move(other.charge)) {}
    Block& operator=(Block&& other) noexcept {
        std::swap(at, other.at);
        std::swap(charge, other.charge);
        return *this;
    }
    ~Block();

    std::byte* data() const { return at; }
    std::size_t capacity() const { return charge.bytes(); }
    /// Keeps the first bytes; the block may move.
    void shrink(std::size_t bytes);

  private:
    std::byte* at = nullptr;
    Charge charge;
};

} // namespace glcast::record
