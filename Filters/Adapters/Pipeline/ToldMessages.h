#ifndef dmgToldMessages_h
#define dmgToldMessages_h

#include <string>

class vtkAlgorithm;
class vtkInformationIntegerKey;
class vtkInformationVector;

/// Messages that the user has read already are not told again. The filter keeps them in its information.
namespace dmg
{

/// Whether a filter has failed in the same way since it or its inputs have changed. The pipeline asks again for each output and each
/// consumer where the outputs are images, since empty ones have no extent.
bool HasFailedBefore(vtkAlgorithm* algorithm, vtkInformationVector** inputs, const std::string& message);

/// Adds a text to field data of the first output, and to VTK's output the first time that this filter does so.
void TellOnce(vtkAlgorithm* algorithm, vtkInformationVector* outputs, vtkInformationIntegerKey* isTold,
  const char* name, const std::string& note);

}

#endif
