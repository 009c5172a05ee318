#ifndef dmgPieceRequest_h
#define dmgPieceRequest_h

class vtkInformation;
class vtkInformationVector;

namespace dmg
{

/// For filters whose result depends on the whole surface: piece 0 works on the whole and the others
/// stay empty. In a parallel run piece and rank are the same.

/// To be called from RequestUpdateExtent: asks for the whole of all inputs where piece 0 is
/// requested, and for nothing elsewhere.
void RequestWholeInPieceZero(
  vtkInformation* request, vtkInformationVector** inputs, int ports, vtkInformationVector* outputs);

/// To be called from RequestData: whether this is the piece to work on. Sources that do not know of
/// pieces deliver the same to all.
bool IsPieceZero(vtkInformation* request, vtkInformationVector* outputs);

}

#endif
