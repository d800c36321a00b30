// The classes of entry points as templates: how each is recorded, written and played. gen_record.py makes one
// alias of these per entry point (packets::Vertex3f), so a call is added by a row in rules.py.
#pragma once
#include <algorithm>
#include <tuple>
#include <type_traits>

#include "shim/record/buffers.h"
#include "shim/record/context.h"
#include "shim/record/player.h"

namespace glcast::record {

/// An alias of a custom call whose parameters differ in type alone.
template <auto member, auto function, class = decltype(member)> struct Forward;
template <auto member, auto function, class R, class... A>
struct Forward<member, function, R (*GlTable::*)(A...)> {
    static R record(A... arguments) { return function(arguments...); }
};

/// What rules.py says of an entry point beside its class.
struct Traits {
    bool compiles; ///< goes into a display list instead of being executed at once
    bool draws;    ///< makes fragments: not played where a draw was not understood, as under a GLSL program
};

template <class Pointer> constexpr std::size_t element_alignment() {
    using Element = std::remove_cv_t<std::remove_pointer_t<Pointer>>;
    if constexpr (std::is_void_v<Element>)
        return 1;
    else
        return alignof(Element);
}
template <class Pointer> constexpr std::size_t element_size() {
    using Element = std::remove_cv_t<std::remove_pointer_t<Pointer>>;
    if constexpr (std::is_void_v<Element>)
        return 1;
    else
        return sizeof(Element);
}

/// Passed through and not recorded: queries, reads, and side effects on objects that contexts share.
template <auto member, GlCall call, class = decltype(member)> struct Once;
template <auto member, GlCall call, class R, class... A> struct Once<member, call, R (*GlTable::*)(A...)> {
    static R record(A... arguments) { return (this_thread.real->*member)(arguments...); }
    static constexpr PlayFunction play = nullptr;
};

/// Passed through and counted: it may change what is seen, and we do not know how.
template <auto member, GlCall call, class = decltype(member)> struct Counted;
template <auto member, GlCall call, class R, class... A> struct Counted<member, call, R (*GlTable::*)(A...)> {
    static R record(A... arguments) {
        if (Context* context = listening_context()) context->count(call);
        return (this_thread.real->*member)(arguments...);
    }
    static constexpr PlayFunction play = nullptr;
};

/// Changes client arrays. They are queried at the next draw, so that is all there is to remember.
template <auto member, GlCall call, class = decltype(member)> struct SetsArrays;
template <auto member, GlCall call, class R, class... A>
struct SetsArrays<member, call, R (*GlTable::*)(A...)> {
    static R record(A... arguments) {
        if (Context* context = listening_context()) context->arrays_dirty = true;
        return (this_thread.real->*member)(arguments...);
    }
    static constexpr PlayFunction play = nullptr;
};

/// Changes the contents of the buffer that is bound to the target that is argument number `at`.
template <auto member, GlCall call, std::size_t at, class = decltype(member)> struct ChangesBound;
template <auto member, GlCall call, std::size_t at, class R, class... A>
struct ChangesBound<member, call, at, R (*GlTable::*)(A...)> {
    static R record(A... arguments) {
        // Forgotten after the call, but looked up before: glUnmapBuffer and its kin leave the binding as it
        // is.
        const ForgetBuffer after(changing_context(), std::get<at>(std::tuple<A...>(arguments...)),
                                 by_target);
        return (this_thread.real->*member)(arguments...);
    }
    static constexpr PlayFunction play = nullptr;
};

/// Changes the contents of the buffer whose name is argument number `at`.
template <auto member, GlCall call, std::size_t at, class = decltype(member)> struct ChangesNamed;
template <auto member, GlCall call, std::size_t at, class R, class... A>
struct ChangesNamed<member, call, at, R (*GlTable::*)(A...)> {
    static R record(A... arguments) {
        const ForgetBuffer after(changing_context(), std::get<at>(std::tuple<A...>(arguments...)), by_name);
        return (this_thread.real->*member)(arguments...);
    }
    static constexpr PlayFunction play = nullptr;
};

/// Reads into client memory, or into the buffer bound to GL_PIXEL_PACK_BUFFER.
template <auto member, GlCall call, class = decltype(member)> struct Packs;
template <auto member, GlCall call, class R, class... A> struct Packs<member, call, R (*GlTable::*)(A...)> {
    static R record(A... arguments) {
        const ForgetBuffer after(changing_context(), GL_PIXEL_PACK_BUFFER, by_target);
        return (this_thread.real->*member)(arguments...);
    }
    static constexpr PlayFunction play = nullptr;
};

/// Recorded and played: values alone. `replayed` is the member that plays it (the core name of an alias).
template <auto member, auto replayed, GlCall op, Traits traits, class = decltype(member)> struct Plain;
template <auto member, auto replayed, GlCall op, Traits traits, class R, class... A>
struct Plain<member, replayed, op, traits, R (*GlTable::*)(A...)> {
    static void write(Stream& stream, A... arguments) {
        Writer writer(stream.append(Op(op), (sizeof(A) + ... + 0)));
        (writer.put(arguments), ...);
    }
    static R record(A... arguments) {
        if (Context* context = listening_context()) {
            if constexpr (traits.draws) context->note_draw();
            context->emit(traits.compiles, [&](Stream& stream) { write(stream, arguments...); });
        }
        return (this_thread.real->*member)(arguments...);
    }
    static void play(Player& player, const Packet& packet) {
        if (traits.draws && player.skips_draws()) return;
        [[maybe_unused]] Reader reader(packet);
        const std::tuple<A...> values{reader.get<A>()...};
        std::apply(player.gl.*replayed, values);
    }
};

/// Recorded and played: values and one pointer, argument number `at`, to `Size::count(arguments...)`
/// elements.
template <auto member, auto replayed, GlCall op, Traits traits, std::size_t at, class Size,
          class = decltype(member)>
struct Vector;
template <auto member, auto replayed, GlCall op, Traits traits, std::size_t at, class Size, class R,
          class... A>
struct Vector<member, replayed, op, traits, at, Size, R (*GlTable::*)(A...)> {
    using Arguments = std::tuple<A...>;
    using Pointer = std::tuple_element_t<at, Arguments>;
    static constexpr std::size_t alignment = std::min<std::size_t>(8, element_alignment<Pointer>());
    static constexpr std::size_t value_bytes = (sizeof(A) + ... + 0) - sizeof(Pointer);
    // From a body that is aligned to 4 to the payload: at most this much padding.
    static constexpr std::size_t slack = alignment == 8 ? 4 : 0;
    static constexpr std::size_t payload_at = (value_bytes + std::min<std::size_t>(alignment, 4) - 1) /
                                              std::min<std::size_t>(alignment, 4) *
                                              std::min<std::size_t>(alignment, 4);

    static void write(Stream& stream, A... arguments) {
        const Arguments values{arguments...};
        const void* from = std::get<at>(values);
        const std::size_t bytes = from ? Size::count(arguments...) * element_size<Pointer>() : 0;
        Writer writer(stream.append(Op(op), payload_at + (bytes ? slack + bytes : 0)));
        put_values(writer, values, std::index_sequence_for<A...>());
        if (bytes) writer.align(alignment).put_bytes(from, bytes);
    }
    static R record(A... arguments) {
        if (Context* context = listening_context()) {
            if constexpr (traits.draws) context->note_draw();
            context->emit(traits.compiles, [&](Stream& stream) { write(stream, arguments...); });
        }
        return (this_thread.real->*member)(arguments...);
    }
    static Arguments read(const Packet& packet) {
        Reader values(packet), payload(packet);
        payload.take(value_bytes);
        payload.align(alignment);
        const std::byte* data = packet.bytes > (payload_at + 3) / 4 * 4 ? payload.position() : nullptr;
        return get_values(values, data, std::index_sequence_for<A...>());
    }
    static void play(Player& player, const Packet& packet) {
        if (traits.draws && player.skips_draws()) return;
        std::apply(player.gl.*replayed, read(packet));
    }

  private:
    template <std::size_t... i>
    static void put_values(Writer& writer, const Arguments& values, std::index_sequence<i...>) {
        (
            [&] {
                if constexpr (i != at) writer.put(std::get<i>(values));
            }(),
            ...);
    }
    template <std::size_t i> static auto get_value(Reader& values, const std::byte* data) {
        if constexpr (i == at)
            return reinterpret_cast<Pointer>(data);
        else
            return values.get<std::tuple_element_t<i, Arguments>>();
    }
    template <std::size_t... i>
    static Arguments get_values(Reader& values, const std::byte* data, std::index_sequence<i...>) {
        return Arguments{get_value<i>(values, data)...};
    }
};

/// Numbers of elements for Vector.
template <std::size_t n> struct Fixed {
    template <class... A> static std::size_t count(A...) { return n; }
};
/// `n` for each of argument number `index`.
template <std::size_t index, std::size_t n = 1> struct Times {
    template <class... A> static std::size_t count(A... arguments) {
        const auto times = std::get<index>(std::tuple<A...>(arguments...));
        return times > 0 ? std::size_t(times) * n : 0;
    }
};
/// What `function` says of the enum that is argument number `index`.
template <std::size_t index, std::size_t (*function)(GLenum)> struct ByEnum {
    template <class... A> static std::size_t count(A... arguments) {
        return function(GLenum(std::get<index>(std::tuple<A...>(arguments...))));
    }
};
/// What `function` says of all arguments.
template <auto function> struct ByAll {
    template <class... A> static std::size_t count(A... arguments) { return function(arguments...); }
};

} // namespace glcast::record
