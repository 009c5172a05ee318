#ifndef dmgReportedMessages_h
#define dmgReportedMessages_h

#include <string>

class vtkAlgorithm;
class vtkInformationVector;

/// Messages that the user has read already are not reported again.
namespace dmg
{

/// Whether a filter has failed in the same way since it or its inputs have changed. The pipeline asks again for each output and each
/// consumer where the outputs are images, since empty ones have no extent.
bool HasFailedBefore(vtkAlgorithm* algorithm, vtkInformationVector** inputs, const std::string& message);

/// Adds a text to field data of the first output, and to VTK's log the first time that a filter of this class has it in this process.
void ReportOnce(
  vtkAlgorithm* algorithm, vtkInformationVector* outputs, const std::string& name, const std::string& note);

}

#endif
