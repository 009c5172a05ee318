#ifndef dmgFieldFiles_h
#define dmgFieldFiles_h

#include <string>

class vtkDataSet;

namespace dmg
{

/// Contents of files that remeshers read. Faces are the cells of two dimensions of a dataset, in their order.

/// The format .rosy: the number of faces, the number N of directions, and a unit vector along Direction0 for each face.
/// \throw InvalidInput there is no cell array Direction0; a face has no direction, or one that is not finite.
std::string RosyFileOf(vtkDataSet* surface);

/// Directional's raw field: N, the number of faces, and the N vectors of each face, as long as Direction0. They are counter-clockwise around
/// the normal that the order of the face's corners gives.
/// \throw InvalidInput as RosyFileOf, but for faces without a direction; a face without area.
std::string RawFieldFileOf(vtkDataSet* surface);

/// The format .sharp: the number of lines, and a line "kind,face,side" for each edge that is sharp or on the boundary. Kind 0 is concave,
/// and 1 is convex or the boundary; side j goes from corner j of the face to the next one. One of the two faces of an edge stands for
/// both; edges of more faces have a line for each of them, of kind 1. Points of the boundary that coincide are one.
/// \param degrees between the normals of both faces, from which on an edge is sharp.
/// \throw InvalidInput a face is no triangle.
std::string SharpFileOf(vtkDataSet* surface, double degrees);

/// A warning where a face is no triangle: the readers of .rosy and of raw fields split it, and then they have more faces than directions.
/// \return empty where all faces are triangles.
std::string WarningOfPolygons(vtkDataSet* surface);

}

#endif
