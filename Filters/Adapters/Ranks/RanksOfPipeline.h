#ifndef dmgRanksOfPipeline_h
#define dmgRanksOfPipeline_h

#include "Support/Processes.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkCharArray;
class vtkMultiProcessController;

namespace dmg
{

/// The processes of VTK's global controller, as those of a parallel ParaView. Functions are collective, from the thread that executes the
/// pipeline.
class RanksOfPipeline : public Processes
{
public:
  /// The ranks are those of the global controller; there may be none.
  RanksOfPipeline();

  std::vector<std::string> Gather(const std::string& here) const override;
  std::vector<long long> Gather(long long here) const;
  /// Whether \p here is true on all ranks.
  bool AreAll(bool here) const;

  /// Brings a text of bytes to rank 0. \param size on all ranks.
  /// \return the bytes on rank 0; null elsewhere.
  vtkSmartPointer<vtkCharArray> ToFirst(vtkCharArray* bytes, int from, long long size) const;

  /// Brings the bytes of rank 0 to all ranks.
  void FromFirst(vtkCharArray* bytes) const;

protected:
  int Least(int here) const override;
  std::string TextOf(int from, const std::string& here) const override;

private:
  vtkMultiProcessController* const All; ///< null where there is one process
};

}

#endif
