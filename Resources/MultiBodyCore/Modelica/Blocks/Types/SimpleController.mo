within Modelica.Blocks.Types;
type SimpleController = enumeration(
    P "Proportional",
    PI "Proportional and integrating",
    PD "Proportional and differentiating",
    PID "Proportional, integrating and differentiating")
  "Kinds of controllers"
  annotation (Documentation(info="<html><p>Choices of the parameter <code>controllerType</code> of LimPID.</p></html>"));
