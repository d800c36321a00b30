// A stream of packets: the calls of a frame or of a display list, packed as tightly as they can be read back.
//
//   packet := header body        header := op:16 words:16  |  op:16 0xFFFF words:32
//   body   := the arguments in order, unaligned, without the pointer; then what the pointer pointed at,
//   aligned for its type
//
// `words` is the length of the body in units of four bytes. A glVertex3f takes 16 bytes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "shim/record/memory.h"

namespace glcast::record {

using Op = std::uint16_t;

struct Packet {
    Op op;
    const std::byte* body;
    std::size_t bytes; ///< of the body, padding included
};

class Stream {
  public:
    Stream() = default;
    Stream(Stream&&) = default;
    Stream& operator=(Stream&&) = default;

    /// Room for a packet's body of `bytes`, aligned to 4. Throws std::bad_alloc, also when all recordings
    /// would take more than their limit, and is then as it was.
    std::byte* append(Op op, std::size_t bytes);

    /// Gives back what the last chunk holds too much: display lists are many and small.
    void shrink();
    std::size_t allocated_bytes() const;
    bool empty() const { return chunks.empty(); }

    template <class Visitor> void for_each(Visitor&& visit) const {
        for (const Chunk& chunk : chunks)
            for_each(Run{chunk.block.data(), chunk.block.data() + chunk.used}, visit);
    }

    /// Whole packets one behind the other.
    struct Run {
        const std::byte *begin, *end;
    };
    template <class Visitor> static void for_each(const Run& run, Visitor&& visit) {
        for (const std::byte* at = run.begin; at != run.end;) {
            const Packet packet = read_header(at);
            visit(packet);
            at = packet.body + packet.bytes;
        }
    }
    /// From packet to packet over all of a stream. Appending ends it.
    class Cursor {
      public:
        explicit Cursor(const Stream& of) : stream(&of) { enter(); }
        bool at_end() const { return chunk == stream->chunks.size(); }
        Packet packet() const { return read_header(at); }
        Run run() const { return {at, packet().body + packet().bytes}; }
        void step() {
            at = run().end;
            if (at != end) return;
            ++chunk;
            enter();
        }

      private:
        void enter() {
            while (!at_end() && stream->chunks[chunk].used == 0) ++chunk;
            if (at_end()) return;
            at = stream->chunks[chunk].block.data();
            end = at + stream->chunks[chunk].used;
        }
        const Stream* stream;
        std::size_t chunk = 0;
        const std::byte *at = nullptr, *end = nullptr;
    };
    /// The packet that was appended last, whose body has so many bytes.
    Run last_packet(std::size_t bytes) const {
        const Chunk& chunk = chunks.back();
        const std::size_t words = (bytes + 3) / 4, header = words >= long_packet ? 8 : 4;
        const std::byte* end = chunk.block.data() + chunk.used;
        return {end - words * 4 - header, end};
    }

    /// How a list leaves Begin/End: glBegin in one list and glEnd in another is legal.
    enum class BeginState : std::uint8_t { unchanged, inside, outside };
    BeginState begin_state = BeginState::unchanged;
    bool draws = false;        ///< it, or a list that it calls
    bool sets_program = false; ///< likewise: a GLSL program is used in it
    bool opaque = false; ///< GL has this list and we do not know its contents (glXUseXFont, out of memory)

  private:
    struct Chunk {
        Block block;
        std::size_t used = 0;
    };
    static Packet read_header(const std::byte* at) {
        std::uint32_t header;
        std::memcpy(&header, at, 4);
        std::uint32_t words = header >> 16;
        if (words != long_packet) return {Op(header), at + 4, words * std::size_t(4)};
        std::memcpy(&words, at + 4, 4);
        return {Op(header), at + 8, words * std::size_t(4)};
    }
    void add_chunk(std::size_t at_least);

    static constexpr std::uint32_t long_packet = 0xFFFF;
    static constexpr std::size_t first_chunk = 256, largest_chunk = std::size_t(1) << 20;
    std::vector<Chunk> chunks;
};

/// Appends values one behind the other into a body; `Reader` takes them out again.
class Writer {
  public:
    explicit Writer(std::byte* body) : at(body) {}
    template <class T> Writer& put(const T& value) {
        std::memcpy(at, &value, sizeof value);
        at += sizeof value;
        return *this;
    }
    Writer& put_bytes(const void* from, std::size_t bytes) {
        if (bytes) std::memcpy(at, from, bytes);
        at += bytes;
        return *this;
    }
    Writer& align(std::size_t alignment) {
        at += padding(at, alignment);
        return *this;
    }
    std::byte* position() const { return at; }

    static std::size_t padding(const void* at, std::size_t alignment) {
        return (alignment - reinterpret_cast<std::uintptr_t>(at) % alignment) % alignment;
    }

  private:
    std::byte* at;
};

class Reader {
  public:
    explicit Reader(const Packet& packet) : at(packet.body), end(packet.body + packet.bytes) {}
    template <class T> T get() {
        T value;
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
        return value;
    }
    Reader& align(std::size_t alignment) {
        at += Writer::padding(at, alignment);
        return *this;
    }
    const std::byte* position() const { return at; }
    const std::byte* take(std::size_t bytes) {
        const std::byte* from = at;
        at += bytes;
        return from;
    }
    bool at_end() const { return at >= end; }

  private:
    const std::byte* at;
    const std::byte* end;
};

} // namespace glcast::record
