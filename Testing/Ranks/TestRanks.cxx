#include "Support/FailuresOfOtherRanks.h"

#include "vtkMPIController.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>

/// Only rank 0 tells of tests that pass; all tell of those that fail.
int main(int count, char** arguments)
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&count, &arguments);
  vtkMultiProcessController::SetGlobalController(controller);
  ::testing::InitGoogleTest(&count, arguments);
  dmg::test::PrintOnFirstRank(controller->GetLocalProcessId());
  const int failed = RUN_ALL_TESTS();
  int anywhere = 0;
  controller->AllReduce(&failed, &anywhere, 1, vtkCommunicator::MAX_OP);
  vtkMultiProcessController::SetGlobalController(nullptr);
  controller->Finalize();
  return anywhere;
}
