# What Godot 3 makes of res://model.glb or res://model.obj: one line "found: {...}", and a picture in out.png.
extends Spatial

var found = {"names": [], "triangles": 0, "hidden": 0, "textures": [], "colours": false, "normals": true}
var box = null

func _ready():
	var model = import_of("res://model")
	add_child(model)
	look(model)
	found["normals"] = found["normals"] and found["names"].size() > 0
	add_lights()
	yield(get_tree(), "idle_frame")
	yield(VisualServer, "frame_post_draw")
	yield(VisualServer, "frame_post_draw")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	image.save_png("res://out.png")
	print("found: ", to_json(found))
	get_tree().quit()

func import_of(stem):
	if ResourceLoader.exists(stem + ".glb"):
		return load(stem + ".glb").instance()
	var item = MeshInstance.new()
	item.mesh = load(stem + ".obj")
	item.name = "model"
	return item

func look(node):
	if node is MeshInstance and node.mesh:
		if node.is_visible_in_tree():
			measure(node)
		else:
			found["hidden"] += 1
	for child in node.get_children():
		look(child)

func measure(item):
	found["names"].append(item.name)
	var here = item.global_transform.xform(item.get_aabb())
	box = here if box == null else box.merge(here)
	for k in range(item.mesh.get_surface_count()):
		var arrays = item.mesh.surface_get_arrays(k)
		found["triangles"] += arrays[Mesh.ARRAY_INDEX].size() / 3
		found["normals"] = found["normals"] and arrays[Mesh.ARRAY_NORMAL] != null
		var material = item.mesh.surface_get_material(k)
		if material is SpatialMaterial:
			if arrays[Mesh.ARRAY_COLOR] != null and material.vertex_color_use_as_albedo or material.albedo_color != Color(1, 1, 1):
				found["colours"] = true
			for slot in [SpatialMaterial.TEXTURE_ALBEDO, SpatialMaterial.TEXTURE_NORMAL]:
				var texture = material.get_texture(slot)
				if texture:
					found["textures"].append([texture.get_width(), texture.get_height()])

func add_lights():
	var size = box.size.length()
	var centre = box.position + box.size / 2
	var camera = Camera.new()
	add_child(camera)
	camera.set_orthogonal(size * 0.95, size * 0.05, size * 10)
	camera.look_at_from_position(centre + Vector3(0.5, 0.5, 0.7).normalized() * size * 2, centre, Vector3(0, 1, 0))
	camera.current = true
	var sun = DirectionalLight.new()
	add_child(sun)
	sun.look_at_from_position(centre + Vector3(0.2, 0.9, 0.5) * size, centre, Vector3(0, 1, 0))
	var environment = WorldEnvironment.new()
	environment.environment = Environment.new()
	environment.environment.background_mode = Environment.BG_COLOR
	environment.environment.background_color = Color(0.5, 0.5, 0.5)
	environment.environment.ambient_light_color = Color(1, 1, 1)
	environment.environment.ambient_light_energy = 0.4
	add_child(environment)
