"""Classes of GL calls: what the rules of override tables and of the recorder name instead of calls.

Names are regular expressions without the gl prefix, matched in full against every entry point of the registry, under any
extension. A call may be in several classes; a class that holds no call of the registry is an error.
"""

TYPES = r"(b|d|f|i|s|ub|ui|us|x|h)"
VENDOR = r"(ARB|EXT|NV|OES|ATI|AMD|APPLE)?"

# name, what is in it, expressions
CLASSES = [
    # What draws.
    ("array_draws", "draws from arrays, whose first argument is the mode",
     r"""(Multi)?Draw(Range)?(Arrays|Elements)(?!.*(IBM|SUN)).* (Multi)?Draw(Range)?ElementArray(ATI|APPLE)
         DrawTransformFeedback.*"""),
    ("mesh_draws", "draws of evaluators, whose first argument is how the mesh is filled", r"EvalMesh[12]"),
    ("rectangles", "glRect: two triangles each", r"Rect(d|f|i|s|x)v?(OES)?"),
    ("begin_end", "what draws between them is one draw", r"Begin End"),
    ("pixels", "pixel rectangles", r"Bitmap DrawPixels CopyPixels"),

    # What stands between glBegin and glEnd.
    ("vertices", "a vertex each", rf"Vertex[23]{TYPES}v?{VENDOR} VertexP[23]uiv? EvalCoord[12].* EvalPoint[12] ArrayElement(EXT)?"),
    ("vertices_with_w", "a vertex with four coordinates each", rf"Vertex4{TYPES}v?{VENDOR} VertexP4uiv?"),
    ("attributes", "generic attributes, whose first argument is the index: number 0 is the vertex",
     rf"VertexAttrib[1-4]N?{TYPES}v?{VENDOR} VertexAttribP[1-4]uiv?"),
    ("colours", "the primary colour of a vertex", rf"Color[34]{TYPES}v?{VENDOR} ColorP[34]uiv?"),

    # Where it is drawn, and what becomes of a fragment.
    ("viewports", "", r"Viewport(Arrayv|Indexedfv?)?"),
    ("scissors", "", r"Scissor(Arrayv|Indexedv?)?"),
    ("depth_ranges", "", r"DepthRange(f|dNV|fOES|Arrayv|Indexed)?"),
    ("stencil", "the test, the operations and the mask", r"Stencil(Func|Op|Mask)(Separate)?(ATI)? ActiveStencilFaceEXT"),
    ("offsets", "of polygons", r"PolygonOffset(EXT|Clamp|ClampEXT)?"),
    ("sample_masks", "", r"SampleCoverage(ARB)? SampleMaski SampleMask(SGIS|EXT) MinSampleShading(ARB)?"),
    ("fog", "", r"Fog[fi]v?"),
    ("lights", "", r"Light[fi]v?"),
    ("materials", "", r"Material[fi]v?"),

    # Framebuffers.
    ("clears", "that name what they clear, and with what",
     r"ClearBuffer(fi|fv|iv|uiv) ClearNamedFramebuffer(fi|fv|iv|uiv)"),
    ("clear_values", "but for the colour", r"ClearColorIu?iEXT ClearIndex ClearDepth(f|fOES|dNV)? ClearStencil ClearAccum"),
    ("framebuffer_bindings", "", r"BindFramebuffer(EXT)?"),
    ("blits", "", r"BlitFramebuffer(EXT)? BlitNamedFramebuffer"),
    ("framebuffers", "all that binds, makes up, copies or deletes one",
     r"""(Bind|Delete)Framebuffers?(EXT)? Blit(Named)?Framebuffer(EXT)? Invalidate(Named)?(Sub)?Framebuffer(Data|SubData)?
         (Named)?Framebuffer(Renderbuffer|Texture([123]D|Layer|Face)?|Parameteri|(Draw|Read)Buffers?)(ARB|EXT)?"""),
    ("renderbuffers", "of the one that is bound", r"(Bind|Delete)Renderbuffers?(EXT)? RenderbufferStorage(Multisample)?(EXT)?"),
    ("draw_buffers", "", r"DrawBuffer DrawBuffers(ARB|ATI)?"),
    ("pixel_reads", "", r"ReadBuffer Readn?Pixels(ARB)?"),
    ("texture_copies", "from the framebuffer into textures", r"Copy(Multi)?Tex(ture)?(Sub)?Image[123]D(EXT)?"),
    ("waits", "", r"Flush Finish"),
    ("queries", "what is counted while it is drawn, and drawing that depends on it",
     r"(Begin|End)Query(ARB|Indexed)? QueryCounter (Begin|End)OcclusionQueryNV (Begin|End)ConditionalRender(NV)?"),

    # Matrices.
    ("matrices", "that change the top of the current stack, and the stack itself",
     r"(Load|Mult)(Transpose)?Matrix[df](ARB)? LoadIdentity Ortho Frustum (Rotate|Scale|Translate)[df] (Push|Pop)Matrix"),
    ("named_matrices", "the same, and the first argument is the stack",
     r"""Matrix(LoadIdentity|(Load|Mult)(Transpose)?[df]|Ortho|Frustum|(Rotate|Scale|Translate)[df]|Push|Pop)EXT"""),

    # Programs.
    ("program_bindings", "", r"UseProgram(ObjectARB)? BindProgramPipeline"),
]


def words_of(*names):
    """The expressions of some classes."""
    by_name = {name: expressions for name, _, expressions in CLASSES}
    return " ".join(by_name[name] for name in names)
