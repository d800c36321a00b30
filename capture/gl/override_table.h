// Override tables: copies of a GlTable in which some calls do something else than in the table below.
//
// Rules in a table say which: calls or a class of calls, what becomes of them, and why. A call that is in no
// rule is that of the table below; the last rule that names a call counts. A call that the driver has not
// stays null, so that a program which looks still finds it missing.
#pragma once
#include <span>

#include "capture/gl/calls.h"

namespace glcast {

/// Entry points get no argument that says whose table they are in. So what they need stands here while the
/// table is in use: one of each kind at a time on a thread.
template <class Owner> inline constinit thread_local Owner* table_owner = nullptr;

/// What becomes of calls.
struct Change {
    void (*install)(GlTable& table, const GlTable& below);
    const char* what; ///< for the page that lists all rules
};

/// The call of the table below an owner's, which has `const GlTable& below() const`.
template <class Owner, auto Member> struct CallBelow {
    static constexpr auto member = Member;
    template <class... Args> auto operator()(Args... args) const {
        return (table_owner<Owner>->below().*Member)(args...);
    }
};

namespace override_table {

template <auto Member, class Function = decltype(Member)> struct Nothing;
template <auto Member, class R, class... Args> struct Nothing<Member, R (APIENTRYP GlTable::*)(Args...)> {
    static R APIENTRY call(Args...) { return R(); }
};

template <class Handler, auto Member, class Function = decltype(Member)> struct Handled;
template <class Handler, auto Member, class R, class... Args>
struct Handled<Handler, Member, R (APIENTRYP GlTable::*)(Args...)> {
    static R APIENTRY call(Args... args) {
        return Handler::call(CallBelow<typename Handler::Owner, Member>(), args...);
    }
};

} // namespace override_table

/// Nothing happens, and 0 is returned.
template <auto... Members> constexpr Change drop(Calls<Members...>) {
    return {[](GlTable& table, const GlTable&) {
                ((table.*Members = table.*Members ? override_table::Nothing<Members>::call : nullptr), ...);
            },
            "left out"};
}

/// `Function` is called instead.
template <auto Function, auto... Members> constexpr Change replace(Calls<Members...>) {
    return {
        [](GlTable& table, const GlTable&) { ((table.*Members = table.*Members ? Function : nullptr), ...); },
        "changed"};
}

/// `Handler::call(below, arguments...)` is called instead, for calls of any signature; `below` is a
/// CallBelow<Handler::Owner, member>, and Handler::what says what happens.
template <class Handler, auto... Members> constexpr Change handle(Calls<Members...>) {
    return {
        [](GlTable& table, const GlTable&) {
            ((table.*Members = table.*Members ? override_table::Handled<Handler, Members>::call : nullptr),
             ...);
        },
        Handler::what};
}

/// As in the table below, whatever a rule before this one says.
template <auto... Members> constexpr Change keep(Calls<Members...>) {
    return {[](GlTable& table, const GlTable& below) { ((table.*Members = below.*Members), ...); },
            "as the program made it"};
}

/// A handler of glEnable and glDisable: what the owner has set, `bool owns(GLenum cap) const`, stays.
template <class TableOwner> struct SwitchNotOwned {
    using Owner = TableOwner;
    static constexpr const char* what = "but for what the table has set";
    static void call(auto below, GLenum cap) {
        if (!table_owner<Owner>->owns(cap)) below(cap);
    }
};

/// A handler of glPushAttrib: glPopAttrib brings nothing of these groups back.
template <class TableOwner, GLbitfield groups> struct SaveWithout {
    using Owner = TableOwner;
    static constexpr const char* what = "but for what the table has set";
    static void call(auto below, GLbitfield mask) { below(mask & ~groups); }
};

inline constexpr unsigned always = ~0u;

struct OverrideRule {
    unsigned when; ///< bits: the circumstances in which the rule holds, any of them
    Change change;
    const char* why;
};

/// `table`, a copy of `below`, becomes what the rules say of these circumstances.
inline void override_calls(GlTable& table, const GlTable& below, std::span<const OverrideRule> rules,
                           unsigned circumstances = always) {
    for (const OverrideRule& rule : rules)
        if (rule.when & circumstances) rule.change.install(table, below);
}

/// The rules of one kind of table, for the page that lists them.
struct OverrideRules {
    const char* name;
    const char* purpose;
    std::span<const OverrideRule> rules;
    std::span<const char* const> circumstances; ///< what each bit of `when` stands for; empty: one only
};

} // namespace glcast
