"""What gl.xml does not say about entry points: how each is recorded.

Names are regular expressions without the gl prefix, matched in full against the core name (glFooARB follows glFoo where
the registry calls it an alias). The first row that matches decides. docs/design/adding-a-gl-call.md explains the classes:

  plain     recorded with its arguments and what they point at, and played
  custom    record function by hand (shim/record/*.cpp, namespace custom)
  arrays    changes client arrays: these are queried at the next draw, so nothing else is kept
  *_buffer  changes the buffer that argument number N names, or that is bound to that target; packs: GL_PIXEL_PACK_BUFFER
  once      passed through: queries, reads, side effects on objects that contexts share
  ignored   passed through on purpose, for the reason beside it
  counted   passed through and counted as not understood (the default beyond GL 2.1)
"""

CLASSES = [
    ("custom", r"""NewList EndList DeleteLists CallList CallLists
        Begin End ArrayElement Rect[dfis]v
        Enable Disable PopAttrib PopMatrix RenderMode UseProgram BindProgramPipeline
        DrawArrays DrawElements DrawRangeElements MultiDrawArrays MultiDrawElements
        Draw(Arrays|Elements)Instanced(BaseVertex)?(BaseInstance)? Draw(Range)?ElementsBaseVertex
        MultiDrawElementsBaseVertex
        DeleteBuffers EndTransformFeedback BindTexture DeleteTextures GenerateMipmap
        Bitmap DrawPixels PolygonStipple Tex(Sub)?Image[123]D CompressedTex(Sub)?Image[123]D CopyTex(Sub)?Image[123]D
        Map[12][df]"""),
    ("arrays", r"""(Vertex|Normal|Color|SecondaryColor|FogCoord|Index|EdgeFlag|TexCoord)Pointer(EXT)?
        (Enable|Disable)ClientState(i|Indexed)?(EXT)? InterleavedArrays VertexAttribI?L?Pointer
        (Enable|Disable)VertexAttribArray BindVertexArray(APPLE)? DeleteVertexArrays PopClientAttrib
        ClientAttribDefaultEXT PushClientAttribDefaultEXT VertexAttribI?L?Format VertexAttribBinding VertexAttribDivisor
        BindVertexBuffers? VertexBindingDivisor VertexArray.* (Enable|Disable)VertexArray.* MultiTexCoordPointerEXT
        VertexPointervINTEL PrimitiveRestartIndex(NV)? NormalPointervINTEL ColorPointervINTEL TexCoordPointervINTEL .*PointerListIBM"""),
    ("bound_buffer:0", r"""BufferData BufferSubData MapBuffer MapBufferRange UnmapBuffer FlushMappedBufferRange
        BufferStorage ClearBuffer(Sub)?Data"""),
    ("bound_buffer:1", r"CopyBufferSubData"),
    ("named_buffer:0", r"""Named(BufferData|BufferSubData|BufferStorage)(EXT)? InvalidateBuffer(Sub)?Data
        (Map|Unmap|FlushMapped)NamedBuffer(Range)?(EXT)? ClearNamedBuffer(Sub)?Data"""),
    ("named_buffer:1", r"CopyNamedBufferSubData"),
    ("packs", r"ReadPixels ReadnPixels Getn?(Compressed)?TexImage"),
    ("once", r"""Gen[A-Z].* Delete[A-Z].* Create[A-Z].* Getn?[A-Z].* Is[A-Z].* Check[A-Z].* Are[A-Z].* Test[A-Z].*
        FeedbackBuffer SelectBuffer PixelStore[fi]
        ClientActiveTexture BindBuffer BindBufferRange BindBufferBase BindBuffersBase BindBuffersRange PushClientAttrib
        PrioritizeTextures BeginQuery EndQuery QueryCounter
        (Begin|End)QueryIndexed BeginTransformFeedback .*(Shader|ShaderSource) ShaderSource .*Attach.* LinkProgram ValidateProgram
        BindAttribLocation BindFragDataLocation(Indexed)? Uniform[1-4].* UniformMatrix.* ProgramUniform.*
        ProgramParameteri ProgramBinary ShaderBinary UniformBlockBinding ReleaseShaderCompiler UseProgramStages
        ProgramStringARB Program(Env|Local)Parameter.*ARB Program(Env|Local)Parameters4fvEXT BindProgramARB
        DetachShader FenceSync ClientWaitSync WaitSync
        Framebuffer(Texture([123]D|Layer|Face)?|Renderbuffer|Parameteri)(ARB|EXT)? RenderbufferStorage.*
        GenerateTextureMipmap TexStorage[123]D Texture(Sub)?Image[123]D
        TextureParameter.* TextureStorage[123]D BindRenderbuffer(EXT)? Sampler[A-Z].*"""),
    # why: names and feedback make no fragments; waiting is the program's; frames of ours need no labels; our own
    # target is cleared by the engine and not by ClearBuffer; copies between framebuffers and to the accumulation buffer
    # make no new geometry
    ("ignored", r"""InitNames LoadName PushName PopName PassThrough Flush Finish Hint ReadBuffer
        ClearBuffer(fv|iv|uiv|fi) Invalidate.* (Push|Pop)(DebugGroup|GroupMarker.*) (Push|Pop)GroupMarkerEXT
        DebugMessage.* Object(Ptr)?Label InsertEventMarkerEXT LabelObjectEXT StringMarkerGREMEDY FrameTerminatorGREMEDY
        MemoryBarrier.* TextureBarrier(NV)? LockArraysEXT UnlockArraysEXT Accum CopyPixels ResizeBuffersMESA
        SampleCoverage MinSampleShading BufferParameteriAPPLE
        .*Color(Sub)?Table.* .*Convolution.* SeparableFilter.* (Reset)?Histogram.* (Reset)?Minmax.* Object(Unp|P)urgeableAPPLE
        .*FragmentShaderATI PassTexCoordATI SampleMapATI (Color|Alpha)FragmentOp[123]ATI SetFragmentShaderConstantATI
        Combiner.*NV FinalCombinerInputNV (Begin|End)OcclusionQueryNV SamplePattern(EXT|SGIS) VertexWeighthv?NV
        VertexAttribs[1-4]hvNV (Set|Finish)Fence(NV|APPLE) FinishObjectAPPLE SampleMask(EXT|SGIS)"""),
    ("plain", r"""ActiveTexture AlphaFunc Blend(Color|Equation|EquationSeparate|Func|FuncSeparate)
        BlitFramebuffer Clear Clear(Accum|Color|Depth|Depthf|Index|Stencil) ClipPlane Color[34][bdfisu]+v? ColorMask ColorMaterial CullFace
        Depth(Func|Mask|Range|Rangef) DepthBoundsEXT DrawBuffer DrawBuffers EdgeFlagv? EvalCoord[12][df]v? EvalMesh[12]
        EvalPoint[12] Fog(Coord)?(f|i|d|fv|iv|dv) FrontFace Frustum Index[dfisub]+v? IndexMask Light(Model)?[fi]v?
        Line(Stipple|Width) ListBase Load(Identity|MatrixNONE|Matrix[df]|TransposeMatrix[df]) LogicOp MapGrid[12][df]
        Material[fi]v? MatrixMode Mult(Transpose)?Matrix[df] MultiTexCoord[1-4][dfis]v? Normal3[bdfis]v? Ortho
        PixelMap(fv|uiv|usv) PixelTransfer[fi] PixelZoom PointParameter[fi]v? PointSize Polygon(Mode|Offset) PushAttrib
        PushMatrix RasterPos[234][dfis]v? Rect[dfis] Rotate[df] Scale[df] Scissor SecondaryColor3[bdfisu]+v? ShadeModel
        Stencil(Func|Mask|Op)(Separate)? StencilFuncSeparateATI ActiveStencilFaceEXT TexCoord[1-4][dfis]v? TexEnv[fi]v? TexGen[dfi]v? TexParameter[fi]v?
        Translate[df] Vertex[234][dfis]v? VertexAttrib[1-4][dfs]v? VertexAttrib4N?(b|ub|i|ui|s|us)v? VertexAttrib4Nub
        (Vertex|TexCoord|MultiTexCoord|Normal|Color|SecondaryColor|VertexAttrib)P[1-4]uiv? Viewport WindowPos[23][dfis]v? BindFramebuffer(EXT)? ProvokingVertex ClampColor PolygonOffset(Clamp|EXT)
        (Vertex[234]|Normal3|Color[34]|SecondaryColor3|TexCoord[1-4]|MultiTexCoord[1-4]|FogCoord)hv?NV VertexAttrib[1-4]hv?NV
        PrimitiveRestartNV WindowPos4[dfis]v?MESA
        Matrix(LoadIdentity|(Load|Mult)(Transpose)?[df]|(Rotate|Scale|Translate)[df]|Frustum|Ortho|Push|Pop)EXT"""),
    ("once", r"GetError GetString"),
]

# Why calls are passed through: the words of docs/reference/entry-points.md. The first row that matches; every call of the classes
# once, packs, arrays, ignored, bound_buffer and named_buffer that the page lists needs one.
REASONS = [
    ("asks, and changes nothing", r"Get[A-Z].* Is[A-Z].* Check[A-Z].* Are[A-Z].* Test[A-Z].*"),
    ("reads pixels into the program's memory or buffer; our copy of that buffer is dropped", r"ReadPixels Readn?Pixels.*"),
    ("arrays and their state are asked for at the next draw, which is recorded with what it reads",
     r""".*Pointer(EXT|ListIBM|vINTEL|ARB)? (En|Dis)ableClientState.* InterleavedArrays (En|Dis)ableVertexAttribArray.*
        BindVertexArray.* DeleteVertexArrays.* P(op|ush)ClientAttrib.* ClientActiveTexture.* BindBuffer.* VertexAttribDivisor.*
        VertexAttrib.*Format.* VertexAttribBinding.* PrimitiveRestartIndex.* VertexArray.* ClientAttribDefaultEXT"""),
    ("how pixels lie in memory: asked for when an image is read", r"PixelStore[fi]"),
    ("the buffer's contents are read at the next draw from it; our copy is dropped",
     r".*Buffer(Sub)?Data.* (Map|Unmap|FlushMapped).*Buffer.* BufferStorage.*"),
    ("makes or deletes names, or objects that contexts share", r"Gen[A-Z].* Delete[A-Z].* Create[A-Z].*"),
    ("selection and feedback make no picture", r"InitNames LoadName PushName PopName PassThrough (Feedback|Select)Buffer"),
    ("waits or hands over: the program's own business", r"Flush Finish .*Sync Fence.* (Set|Finish|Test)(Fence|Object).*"),
    ("a hint", r"Hint PrioritizeTextures.*"),
    ("the program's own measurement; a frame cannot begin inside one, and is replayed without",
     r"(Begin|End)Query.* QueryCounter.* (Begin|End)OcclusionQuery.*"),
    ("copies pixels on the screen and makes no geometry", r"Accum CopyPixels ReadBuffer ClearBuffer.*"),
    ("our images have one sample", r"SampleCoverage.* MinSampleShading.* Sample(Mask|Pattern).*"),
    ("weights and generic attributes are read by programs alone", r"VertexWeigh.* VertexAttribs.*"),
    ("tells the driver that arrays will not change", r"LockArraysEXT UnlockArraysEXT"),
    ("the window's size is the driver's business", r"ResizeBuffersMESA"),
    ("draws under programs are counted and not cast, so their parts need not be replayed",
     r""".*Shader.* .*Program.* Uniform.* .*Attach.* (Bind|Get)AttribLocation.* BindFragDataLocation.* .*ATI Combiner.* FinalCombiner.*
        SampleMap.* PassTexCoord.* (Alpha|Color)FragmentOp.* ExecuteProgramNV TrackMatrixNV"""),
    ("the program's framebuffers are not shared; draws into them are told apart by glBindFramebuffer",
     r"Framebuffer.* Renderbuffer.* BindRenderbuffer.* Invalidate.* DiscardFramebuffer.*"),
    ("changes textures that contexts share: it has happened when the frame is played",
     r"Texture.* TexStorage.* GenerateTextureMipmap TexBuffer.*"),
    ("labels and markers", r".*DebugGroup.* DebugMessage.* Object(Ptr)?Label.* .*EventMarker.* LabelObject.* .*GREMEDY"),
    ("geometry captured by transform feedback is drawn by shaders", r".*TransformFeedback.*"),
    ("state of samplers and images of shaders", r"Sampler.* BindSampler.*"),
    ("tables and filters of ARB_imaging change images only, and no driver of today has them",
     r".*ColorTable.* .*ColorSubTable.* .*Convolution.* .*SeparableFilter.* .*Histogram.* .*Minmax.*"),
    ("what may be thrown away", r"Object(Unp|P)urgeableAPPLE BufferParameteriAPPLE"),
]

# Plain calls that a display list does not hold: they are executed while it is compiled.
NOT_COMPILED = r"BindFramebuffer(EXT)? GenerateMipmap"

# Calls that make fragments, or only mean something between glBegin and glEnd: classes of capture/gl/call_classes.py, and
# what is in none of them. Draws from arrays are packets of their own.
DRAW_CLASSES = "mesh_draws rectangles begin_end vertices vertices_with_w attributes"
OTHER_DRAWS = r"Bitmap DrawPixels PrimitiveRestartNV"

# Played by hand (namespace custom, play_NAME): they change what later packets depend on, or touch shared objects.
HAND_PLAYED = r"""CallList CallLists ListBase BindTexture TexParameter[fi]v? GenerateMipmap PushAttrib
    PopAttrib RenderMode UseProgram BindProgramPipeline Enable Disable Tex(Sub)?Image[123]D
    CompressedTex(Sub)?Image[123]D"""

# Where the registry says COMPSIZE: elements behind the pointer, by core name. `$param` is that parameter's number.
SIZES = [
    (r"Fog[fi]v", "ByEnum<$pname, sizes::fog>"),
    (r"Light[fi]v", "ByEnum<$pname, sizes::light>"),
    (r"LightModel[fi]v", "ByEnum<$pname, sizes::light_model>"),
    (r"Material[fi]v", "ByEnum<$pname, sizes::material>"),
    (r"PointParameter[fi]v", "ByEnum<$pname, sizes::point_parameter>"),
    (r"TexEnv[fi]v", "ByEnum<$pname, sizes::tex_env>"),
    (r"TexGen[dfi]v", "ByEnum<$pname, sizes::tex_gen>"),
    (r"TexParameter[fi]v", "ByEnum<$pname, sizes::tex_parameter>"),
    (r"PolygonStipple", "Fixed<128>"),
    (r"Map1[df]", "ByAll<sizes::map1>"),
    (r"Map2[df]", "ByAll<sizes::map2>"),
    (r"Bitmap", "ByAll<sizes::bitmap>"),
    (r"DrawPixels", "ByAll<sizes::draw_pixels>"),
    (r"TexImage1D", "ByAll<sizes::tex_image_1d>"),
    (r"TexImage2D", "ByAll<sizes::tex_image_2d>"),
    (r"TexImage3D", "ByAll<sizes::tex_image_3d>"),
    (r"TexSubImage1D", "ByAll<sizes::tex_sub_image_1d>"),
    (r"TexSubImage2D", "ByAll<sizes::tex_sub_image_2d>"),
    (r"TexSubImage3D", "ByAll<sizes::tex_sub_image_3d>"),
]

# Same meaning, though the registry does not call them aliases.
ALIASES = {"BindFramebufferEXT": "BindFramebuffer", "BindVertexArrayAPPLE": "BindVertexArray",
           "DeleteTexturesEXT": "DeleteTextures"}

# Through table() even while nothing is recorded: display lists cannot be read back. All else is queried when needed.
ALWAYS_SHADOWED = r"NewList EndList DeleteLists"
