#ifndef dmgFiniteArrays_h
#define dmgFiniteArrays_h

class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
class vtkFieldData;

namespace dmg
{

/// \param output of any type; of a composite dataset all leaves are looked at.
/// \param input whose points and arrays may be part of the output, and are not looked at.
/// \throw SolverFailure a point or a number in an array of doubles is not finite, but for NaN where it is allowed; the message names the
///   array.
/// Cost: linear.
void CheckArraysAreFinite(vtkDataObject* output, vtkDataSet* input);

/// Says of a new array that NaN stands in it where there is nothing, until it has been checked. Null is passed over.
void AllowNaN(vtkAbstractArray* array);

/// Says of new arrays that their numbers are those of the user, who may have any, until they have been checked.
void AllowAnyNumber(vtkFieldData* arrays);

}

#endif
