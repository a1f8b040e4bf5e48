"""Named nodes of exported glTF scenes as Blender shows them, against the file (scripts/check_export.sh --blender).

Usage: in_blender.py FILE..., in an interpreter that has the package bpy.
"""
import os
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from export_readers import Glb, rotated  # noqa: E402  pylint: disable=wrong-import-position


def worst_of(path):
    """[m], over twenty key frames and all named nodes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    glb, scene = Glb(path), bpy.context.scene
    rate = scene.render.fps * scene.render.fps_base
    root = glb.json["nodes"][0]
    worst = 0.0
    for k in range(0, len(glb.times), max(1, len(glb.times) // 20)):
        frame = glb.times[k] * rate
        scene.frame_set(int(frame), subframe=frame - int(frame))
        graph = bpy.context.evaluated_depsgraph_get()
        for body, node in glb.nodes.items():
            if "node_names" not in glb.json["meshes"][node["mesh"]].get("extras", {}):
                continue
            shown = bpy.data.objects[body].evaluated_get(graph)
            mesh = shown.to_mesh()
            expected = glb.points(body, k)
            found = [shown.matrix_world @ v.co for v in mesh.vertices][-len(expected):]
            for p, q in zip(expected, found, strict=True):
                x, y, z = rotated(root["rotation"], [a - b for a, b in zip(p, root["extras"]["origin_m"])])
                worst = max(worst, *(abs(a - b) for a, b in zip((x, -z, y), q)))  # z up in Blender
            shown.to_mesh_clear()
    return worst


def main():
    failed = False
    for name in sys.argv[1:]:
        worst = worst_of(pathlib.Path(name))
        print(f"{pathlib.Path(name).stem} in Blender {bpy.app.version_string}: named nodes {worst:.1e} m", flush=True)
        failed = failed or not worst <= 1e-5
    return 1 if failed else 0


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # the module may crash while Python takes it down
