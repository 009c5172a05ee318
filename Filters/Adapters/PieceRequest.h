#ifndef dmgPieceRequest_h
#define dmgPieceRequest_h

class vtkInformation;
class vtkInformationVector;

namespace dmg
{

/// To be called from RequestUpdateExtent of a filter whose result depends on the whole surface: asks
/// for the whole of all inputs where piece 0 is requested, and for nothing elsewhere. In a parallel
/// run piece and rank are the same, so rank 0 works on the whole and the others stay empty.
void RequestWholeInPieceZero(
  vtkInformation* request, vtkInformationVector** inputs, int ports, vtkInformationVector* outputs);

}

#endif
