# The capture engine. Linked into a preloaded library: no static constructors, no iostream.
add_library(glcast_engine STATIC
    coincident.cpp
    depth_offset.cpp
    engine.cpp
    engine_blend.cpp
    engine_box.cpp
    engine_layers.cpp
    engine_normal.cpp
    engine_pass.cpp
    engine_peel.cpp
    engine_sides.cpp
    engine_slab.cpp
    engine_target.cpp
    sought.cpp
    forced_calls.cpp
    forced_caps.cpp
    forced_state.cpp
    forced_table.cpp
    program_stencil.cpp
    solidity.cpp)
target_link_libraries(glcast_engine PUBLIC glcast_gl glcast_view glcast_options)

# Box, views and images: what the engine makes and the reconstruction takes.
add_library(glcast_view STATIC camera.cpp reference_views.cpp view.cpp)
target_link_libraries(glcast_view PUBLIC $<BUILD_INTERFACE:glcast_options>)
glcast_package(glcast_view HEADERS view.h view_image.h)
