"""Quads by Blender's QuadriFlow, for BenchmarkQuads.

    blender -b --python-exit-code 1 --python QuadriFlow.py -- SURFACE.ply NUMBER RESULT.txt

The result: Blender's version, processor seconds of the operator, megabytes at the peak beyond those before, the numbers of vertices and quads,
coordinates, quads.
"""
import resource
import sys
import time

import bpy


def megabytes():
    return 1.024e-3 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


path, number, result = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_mesh.ply(filepath=path)
before, start = megabytes(), time.process_time()
bpy.ops.object.quadriflow_remesh(mode="FACES", target_faces=int(number), use_mesh_symmetry=False, use_preserve_boundary=True)
seconds, growth = time.process_time() - start, megabytes() - before
mesh = bpy.context.active_object.data
quads = [tuple(polygon.vertices) for polygon in mesh.polygons]
if any(len(quad) != 4 for quad in quads):
    raise RuntimeError("some polygons are no quads")  # as the surface itself, where QuadriFlow gave up
with open(result, "w", encoding="ascii") as file:
    print(bpy.app.version_string, seconds, growth, len(mesh.vertices), len(quads), file=file)
    for vertex in mesh.vertices:
        print(*vertex.co, file=file)
    for quad in quads:
        print(*quad, file=file)
