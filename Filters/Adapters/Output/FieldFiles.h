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

/// Directional's raw field: N, the number of faces, and the N vectors of each face, counter-clockwise, as long as Direction0.
/// \throw InvalidInput as RosyFileOf, but for faces without a direction; a face without area.
std::string RawFieldFileOf(vtkDataSet* surface);

/// The format .sharp: the number of edges of the boundary and of sharp edges, and "kind,face,side" for each. Kind 0 is concave, and 1 is
/// convex or the boundary; side j goes from corner j of the face to the next one. Points of the boundary that coincide are one.
/// \param degrees between the normals of both faces, from which on an edge is sharp.
/// \throw InvalidInput a face is no triangle.
std::string SharpFileOf(vtkDataSet* surface, double degrees);

}

#endif
