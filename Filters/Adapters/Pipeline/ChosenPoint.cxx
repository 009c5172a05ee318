#include "Adapters/Pipeline/ChosenPoint.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"

#include <algorithm>
#include <limits>

namespace dmg
{

ChosenPoint::ChosenPoint(vtkAlgorithm* filter, double position[3])
  : Position(position)
{
  this->Forget();
  filter->AddObserver(vtkCommand::StartEvent, this, &ChosenPoint::BeginExecution);
  filter->AddObserver(vtkCommand::EndEvent, this, &ChosenPoint::EndExecution);
}

void ChosenPoint::Add(const Vector3& position)
{
  this->Forget();
  if (this->Number++ == 0)
  {
    std::copy_n(position.data(), 3, this->Position);
  }
}

void ChosenPoint::BeginExecution()
{
  if (this->OpenExecutions++ == 0)
  {
    this->Number = 0;
    this->Forget();
  }
}

void ChosenPoint::EndExecution()
{
  this->OpenExecutions = std::max(0, this->OpenExecutions - 1);
}

void ChosenPoint::Forget()
{
  std::fill_n(this->Position, 3, std::numeric_limits<double>::quiet_NaN());
}

}
