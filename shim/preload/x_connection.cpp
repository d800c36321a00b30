#include "shim/preload/x_connection.h"

#include <dlfcn.h>
#include <sys/uio.h>
#include <unistd.h>
#include <xcb/xcb.h>
#include <xcb/xcbext.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

#include "shim/preload/real.h"

namespace glcast::preload {
namespace {

struct Free {
    void operator()(void* memory) const { std::free(memory); }
};
template <class T> using Reply = std::unique_ptr<T, Free>;

// XInput 2: X11/extensions/XI2proto.h. X-Resource 1.2: X11/extensions/XResproto.h.
constexpr std::uint8_t xi_select_events = 46, xi_query_version = 47, xres_query_client_ids = 4;
constexpr std::uint16_t xi_all_master_devices = 1, xi_raw_key_press = 13, xi_raw_key_release = 14;
constexpr std::uint32_t xres_process_id = 2;
xcb_extension_t input_extension = {"XInputExtension", 0}, resource_extension = {"X-Resource", 0};

constexpr int most_windows = 4096;
constexpr int smallest_window = 16; // narrower ones are helpers, not views

} // namespace

#define GLCAST_XCB_CALLS(X)                                                                                  \
    X(xcb_connect)                                                                                           \
    X(xcb_connection_has_error)                                                                              \
    X(xcb_disconnect)                                                                                        \
    X(xcb_get_file_descriptor)                                                                               \
    X(xcb_flush)                                                                                             \
    X(xcb_get_setup)                                                                                         \
    X(xcb_setup_roots_iterator)                                                                              \
    X(xcb_get_extension_data)                                                                                \
    X(xcb_send_request)                                                                                      \
    X(xcb_wait_for_reply)                                                                                    \
    X(xcb_poll_for_event)                                                                                    \
    X(xcb_get_keyboard_mapping)                                                                              \
    X(xcb_get_keyboard_mapping_reply)                                                                        \
    X(xcb_query_tree)                                                                                        \
    X(xcb_query_tree_reply)                                                                                  \
    X(xcb_get_window_attributes)                                                                             \
    X(xcb_get_window_attributes_reply)                                                                       \
    X(xcb_get_geometry)                                                                                      \
    X(xcb_get_geometry_reply)                                                                                \
    X(xcb_get_property)                                                                                      \
    X(xcb_get_property_reply)                                                                                \
    X(xcb_intern_atom)                                                                                       \
    X(xcb_intern_atom_reply)                                                                                 \
    X(xcb_send_event)                                                                                        \
    X(xcb_configure_window)                                                                                  \
    X(xcb_unmap_window)                                                                                      \
    X(xcb_map_window)

struct XConnection::Calls {
#define GLCAST_MEMBER(NAME) decltype(&::NAME) NAME = nullptr;
    GLCAST_XCB_CALLS(GLCAST_MEMBER)
#undef GLCAST_MEMBER
};

struct XConnection::Windows {
    struct Window {
        xcb_window_t name;
        std::uint16_t width, height;
    };
    std::vector<Window> all, top; ///< of this process, mapped; those that are in no other of them
};

const XConnection::Calls* XConnection::calls() {
    static const Calls* const found = []() -> const Calls* {
        void* library = real_dlopen()("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);
        if (!library) return nullptr;
        auto* table = new Calls;
        bool complete = true;
#define GLCAST_FIND(NAME)                                                                                    \
    table->NAME = reinterpret_cast<decltype(&::NAME)>(real_dlsym()(library, #NAME));                         \
    complete &= table->NAME != nullptr;
        GLCAST_XCB_CALLS(GLCAST_FIND)
#undef GLCAST_FIND
        return complete ? table : nullptr;
    }();
    return found;
}

namespace {

xcb_connection_t* as_xcb(void* connection) { return static_cast<xcb_connection_t*>(connection); }

/// A request of an extension; xcb fills in the first four bytes. Its sequence number.
template <class Calls>
unsigned send(const Calls& x, void* connection, xcb_extension_t& extension, std::uint8_t opcode,
              bool answered, std::vector<std::uint8_t> body) {
    body.insert(body.begin(), 4, 0);
    iovec parts[4] = {}; // xcb wants two of its own before ours
    parts[2] = {body.data(), body.size()};
    xcb_protocol_request_t request{};
    request.count = 1;
    request.ext = &extension;
    request.opcode = opcode;
    request.isvoid = !answered;
    return x.xcb_send_request(as_xcb(connection), XCB_REQUEST_CHECKED, parts + 2, &request);
}

template <class... Numbers> std::vector<std::uint8_t> bytes(Numbers... numbers) {
    std::vector<std::uint8_t> all;
    const auto put = [&](const auto& number) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(&number);
        all.insert(all.end(), first, first + sizeof number);
    };
    (put(numbers), ...);
    return all;
}

/// The answer, or null for an error.
template <class Calls> Reply<std::uint8_t> answer(const Calls& x, void* connection, unsigned request) {
    xcb_generic_error_t* error = nullptr;
    Reply<std::uint8_t> reply(
        static_cast<std::uint8_t*>(x.xcb_wait_for_reply(as_xcb(connection), request, &error)));
    std::free(error);
    return reply;
}

std::uint32_t word_at(const std::uint8_t* at) {
    std::uint32_t word;
    std::memcpy(&word, at, sizeof word);
    return word;
}

/// The numbers that the ids of this process's windows begin with: X-Resource knows the process of each
/// client.
template <class Calls> std::vector<std::uint32_t> own_clients(const Calls& x, void* connection) {
    std::vector<std::uint32_t> found;
    const auto* extension = x.xcb_get_extension_data(as_xcb(connection), &resource_extension);
    if (!extension || !extension->present) return found;
    const auto request = send(x, connection, resource_extension, xres_query_client_ids, true,
                              bytes(std::uint32_t{1}, std::uint32_t{0}, xres_process_id));
    const auto reply = answer(x, connection, request);
    if (!reply) return found;
    const std::uint8_t *at = reply.get() + 32, *end = at + std::size_t(word_at(reply.get() + 4)) * 4;
    for (std::uint32_t left = word_at(reply.get() + 8); left > 0 && end - at >= 12; --left) {
        const std::uint32_t client = word_at(at), length = word_at(at + 8);
        if (length >= 4 && end - at >= 16 && word_at(at + 12) == std::uint32_t(getpid()))
            found.push_back(client);
        at += 12 + length;
    }
    return found;
}

} // namespace

std::unique_ptr<XConnection> XConnection::open(const std::string& display, std::string& why) {
    if (!calls()) {
        why = "no libxcb.so.1";
        return nullptr;
    }
    std::unique_ptr<XConnection> made(new XConnection);
    made->connection = calls()->xcb_connect(display.empty() ? nullptr : display.c_str(), nullptr);
    if (made->alive()) return made;
    why = "no connection to the X server";
    return nullptr;
}

XConnection::~XConnection() { calls()->xcb_disconnect(as_xcb(connection)); }

bool XConnection::alive() const {
    return connection && calls()->xcb_connection_has_error(as_xcb(connection)) == 0;
}

int XConnection::file_descriptor() const { return calls()->xcb_get_file_descriptor(as_xcb(connection)); }

std::string XConnection::watch_key(std::uint32_t symbol) {
    const Calls& x = *calls();
    const auto* extension = x.xcb_get_extension_data(as_xcb(connection), &input_extension);
    if (!extension || !extension->present) return "the X server has no XInput extension";
    input_opcode = extension->major_opcode;
    const auto version = send(x, connection, input_extension, xi_query_version, true,
                              bytes(std::uint16_t{2}, std::uint16_t{0}));
    if (!answer(x, connection, version)) return "the X server has no XInput 2";
    key = symbol;
    auto screens = x.xcb_setup_roots_iterator(x.xcb_get_setup(as_xcb(connection)));
    if (!screens.data) return "the X server has no screen";
    const std::uint32_t mask = 1u << xi_raw_key_press | 1u << xi_raw_key_release;
    send(x, connection, input_extension, xi_select_events, false,
         bytes(screens.data->root, std::uint16_t{1}, std::uint16_t{0}, xi_all_master_devices,
               std::uint16_t{1}, mask));
    x.xcb_flush(as_xcb(connection));
    return {};
}

namespace {

/// Does the key with this code make the symbol, shifted or not?
template <class Calls>
bool makes(const Calls& x, void* connection, std::uint32_t code, std::uint32_t symbol) {
    const auto* setup = x.xcb_get_setup(as_xcb(connection));
    if (code < setup->min_keycode || code > setup->max_keycode) return false;
    const auto request = x.xcb_get_keyboard_mapping(as_xcb(connection), xcb_keycode_t(code), 1);
    const Reply<xcb_get_keyboard_mapping_reply_t> reply(
        x.xcb_get_keyboard_mapping_reply(as_xcb(connection), request, nullptr));
    if (!reply) return false;
    const auto* symbols = reinterpret_cast<const xcb_keysym_t*>(reply.get() + 1);
    return std::find(symbols, symbols + std::min<int>(reply->keysyms_per_keycode, 2), symbol) !=
           symbols + std::min<int>(reply->keysyms_per_keycode, 2);
}

} // namespace

int XConnection::key_presses() {
    const Calls& x = *calls();
    int presses = 0;
    for (;;) {
        const Reply<xcb_generic_event_t> event(x.xcb_poll_for_event(as_xcb(connection)));
        if (!event) return presses;
        const auto* generic = reinterpret_cast<const xcb_ge_generic_event_t*>(event.get());
        if (event->response_type != XCB_GE_GENERIC || generic->extension != input_opcode) continue;
        const std::uint32_t code = word_at(reinterpret_cast<const std::uint8_t*>(event.get()) + 16);
        if (!makes(x, connection, code, key)) continue;
        const bool pressed = generic->event_type == xi_raw_key_press;
        presses += pressed && !key_is_down; // held down, it repeats
        key_is_down = pressed;
    }
}

XConnection::Windows XConnection::find_windows() {
    const Calls& x = *calls();
    Windows found;
    const auto* setup = x.xcb_get_setup(as_xcb(connection));
    const std::vector<std::uint32_t> clients = own_clients(x, connection);
    struct Step {
        xcb_window_t window;
        bool inside; ///< a window of this process
    };
    std::vector<Step> steps;
    for (auto screen = x.xcb_setup_roots_iterator(setup); screen.rem > 0; --screen.rem, ++screen.data)
        if (steps.empty()) steps.push_back({screen.data->root, false});
    for (std::size_t i = 0; i < steps.size() && i < most_windows; ++i) {
        const Step step = steps[i];
        const bool ours = std::find(clients.begin(), clients.end(), step.window & ~setup->resource_id_mask) !=
                          clients.end();
        const auto ask = x.xcb_query_tree(as_xcb(connection), step.window);
        const auto ask_state = x.xcb_get_window_attributes(as_xcb(connection), step.window);
        const auto ask_size = x.xcb_get_geometry(as_xcb(connection), step.window);
        const Reply<xcb_query_tree_reply_t> tree(x.xcb_query_tree_reply(as_xcb(connection), ask, nullptr));
        const Reply<xcb_get_window_attributes_reply_t> state(
            x.xcb_get_window_attributes_reply(as_xcb(connection), ask_state, nullptr));
        const Reply<xcb_get_geometry_reply_t> size(
            x.xcb_get_geometry_reply(as_xcb(connection), ask_size, nullptr));
        if (!tree || !state || !size || state->map_state != XCB_MAP_STATE_VIEWABLE) continue;
        const bool view = ours && state->_class == XCB_WINDOW_CLASS_INPUT_OUTPUT &&
                          size->width >= smallest_window && size->height >= smallest_window;
        if (view) found.all.push_back({step.window, size->width, size->height});
        if (view && !step.inside) found.top.push_back(found.all.back());
        const auto* children = reinterpret_cast<const xcb_window_t*>(tree.get() + 1);
        for (int child = 0; child < tree->children_len; ++child)
            steps.push_back({children[child], step.inside || view});
    }
    return found;
}

bool XConnection::is_viewable(std::uint32_t window) {
    const Calls& x = *calls();
    const auto ask = x.xcb_get_window_attributes(as_xcb(connection), window);
    xcb_generic_error_t* error = nullptr;
    const Reply<xcb_get_window_attributes_reply_t> state(
        x.xcb_get_window_attributes_reply(as_xcb(connection), ask, &error));
    std::free(error);
    return state && state->map_state == XCB_MAP_STATE_VIEWABLE;
}

namespace {

constexpr std::uint32_t longest_title = 128; // 4 bytes each
constexpr int deepest_window = 16;

template <class Calls> xcb_atom_t atom(const Calls& x, void* connection, std::string_view name) {
    const auto ask = x.xcb_intern_atom(as_xcb(connection), 1, std::uint16_t(name.size()), name.data());
    const Reply<xcb_intern_atom_reply_t> reply(x.xcb_intern_atom_reply(as_xcb(connection), ask, nullptr));
    return reply ? reply->atom : xcb_atom_t(XCB_ATOM_NONE);
}

template <class Calls>
std::string text_property(const Calls& x, void* connection, xcb_window_t window, xcb_atom_t name) {
    if (name == XCB_ATOM_NONE) return {};
    const auto ask = x.xcb_get_property(as_xcb(connection), 0, window, name, XCB_ATOM_ANY, 0, longest_title);
    const Reply<xcb_get_property_reply_t> reply(x.xcb_get_property_reply(as_xcb(connection), ask, nullptr));
    if (!reply || reply->format != 8) return {};
    std::string text(reinterpret_cast<const char*>(reply.get() + 1), reply->value_len);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return text;
}

} // namespace

std::string XConnection::title(std::uint32_t window) {
    const Calls& x = *calls();
    const xcb_atom_t modern = atom(x, connection, "_NET_WM_NAME");
    for (int depth = 0; depth < deepest_window && window != 0; ++depth) {
        for (const xcb_atom_t name : {modern, xcb_atom_t(XCB_ATOM_WM_NAME)})
            if (std::string text = text_property(x, connection, window, name); !text.empty()) return text;
        const auto ask = x.xcb_query_tree(as_xcb(connection), window);
        const Reply<xcb_query_tree_reply_t> tree(x.xcb_query_tree_reply(as_xcb(connection), ask, nullptr));
        if (!tree) return {};
        window = tree->parent;
    }
    return {};
}

int XConnection::expose_windows() {
    const Calls& x = *calls();
    const Windows windows = find_windows();
    for (const Windows::Window& window : windows.all) {
        xcb_expose_event_t event{};
        event.response_type = XCB_EXPOSE;
        event.window = window.name;
        event.width = window.width, event.height = window.height;
        char wire[32] = {};
        std::memcpy(wire, &event, sizeof event);
        x.xcb_send_event(as_xcb(connection), 0, window.name, XCB_EVENT_MASK_EXPOSURE, wire);
    }
    x.xcb_flush(as_xcb(connection));
    return int(windows.all.size());
}

void XConnection::widen_windows(int pixels) {
    const Calls& x = *calls();
    for (const Windows::Window& window : find_windows().top) {
        const std::uint32_t width = std::uint32_t(window.width + pixels);
        x.xcb_configure_window(as_xcb(connection), window.name, XCB_CONFIG_WINDOW_WIDTH, &width);
    }
    x.xcb_flush(as_xcb(connection));
}

std::vector<std::uint32_t> XConnection::unmap_windows() {
    const Calls& x = *calls();
    std::vector<std::uint32_t> names;
    for (const Windows::Window& window : find_windows().top) {
        x.xcb_unmap_window(as_xcb(connection), window.name);
        names.push_back(window.name);
    }
    x.xcb_flush(as_xcb(connection));
    return names;
}

void XConnection::map_windows(const std::vector<std::uint32_t>& windows) {
    const Calls& x = *calls();
    for (const std::uint32_t window : windows) x.xcb_map_window(as_xcb(connection), window);
    if (!windows.empty()) x.xcb_flush(as_xcb(connection));
}

} // namespace glcast::preload
