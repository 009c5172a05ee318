#include "Adapters/Pipeline/InnerFilter.h"

#include "Support/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <string>
#include <vector>

namespace dmg
{

namespace
{

struct Listener
{
  vtkAlgorithm* Inner;
  const ExecutionContext& Context;
  std::vector<std::string> Messages;
  bool Failed = false;

  /// VTK writes "ERROR: In file, line 7", then "vtkClass (0x123): message".
  void AddMessage(const std::string& text)
  {
    const std::size_t start = text.find("): ");
    std::string message = start == std::string::npos ? text : text.substr(start + 3);
    message.erase(message.find_last_not_of(" \n") + 1);
    this->Messages.push_back(message);
  }

  void Hear(vtkObject* caller, unsigned long event, void* data)
  {
    if (event == vtkCommand::ProgressEvent)
    {
      try
      {
        this->Context.Checkpoint(this->Inner->GetProgress());
      }
      catch (const Cancelled&) // no exception passes VTK's own code
      {
        this->Inner->SetAbortExecute(1);
      }
      return;
    }
    this->Failed = this->Failed || event == vtkCommand::ErrorEvent;
    if (caller == this->Inner) // its executive says no more than that it failed
    {
      this->AddMessage(static_cast<const char*>(data));
    }
  }
};

}

bool UpdateInside(vtkAlgorithm* outer, vtkAlgorithm* inner, const ExecutionContext& context, int piece, int pieces)
{
  Listener listener{ inner, context, {} };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&listener);
  command->SetCallback([](vtkObject* caller, unsigned long event, void* heard, void* data)
    { static_cast<Listener*>(heard)->Hear(caller, event, data); });
  for (const unsigned long event : { vtkCommand::ProgressEvent, vtkCommand::WarningEvent, vtkCommand::ErrorEvent })
  {
    inner->AddObserver(event, command);
  }
  inner->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, command);
  inner->UpdatePiece(piece, pieces, 0);
  inner->RemoveObserver(command);
  inner->GetExecutive()->RemoveObserver(command);
  context.Checkpoint(1.0);
  for (const std::string& message : listener.Messages)
  {
    vtkWarningWithObjectMacro(outer, << message);
  }
  return !listener.Failed;
}

}
