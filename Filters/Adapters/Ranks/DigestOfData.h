#ifndef dmgDigestOfData_h
#define dmgDigestOfData_h

#include <string>

class vtkDataObject;

namespace dmg
{

/// The type, the sizes and the box around the points, which tell most data objects apart at a glance. It is empty where there are no points.
std::string OutlineOf(vtkDataObject* data);

/// Fingerprint of all that a data object holds: points, cells and arrays with their names. Equal for equal content. It guards against
/// accidents, not against forgery. Cost: linear; composite and structured data take as much memory again.
std::string DigestOfData(vtkDataObject* data);

}

#endif
