within Modelica.Blocks.Continuous;
block Integrator "Integral of the input"
  import Modelica.Blocks.Types.Init;
  parameter Real k=1 "Factor";
  parameter Boolean use_reset=false "= true, if the input reset exists";
  parameter Boolean use_set=false "= true, if the input set exists";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.InitialState "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  extends Modelica.Blocks.Interfaces.SISO(y(start=y_start));
  Modelica.Blocks.Interfaces.BooleanInput reset if use_reset "The output is set when this becomes true"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90, origin={60,-120})));
  Modelica.Blocks.Interfaces.RealInput set if use_reset and use_set "Value the output is set to, else y_start"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=270, origin={60,120})));
protected
  Modelica.Blocks.Interfaces.BooleanOutput local_reset "reset, if it exists";
  Modelica.Blocks.Interfaces.RealOutput local_set "set, if it exists";
initial equation
  if initType == Init.SteadyState then
    der(y) = 0;
  elseif initType == Init.InitialState or initType == Init.InitialOutput then
    y = y_start;
  end if;
equation
  if use_reset then
    connect(reset, local_reset);
    if use_set then
      connect(set, local_set);
    else
      local_set = y_start;
    end if;
    when local_reset then
      reinit(y, local_set);
    end when;
  else
    local_reset = false;
    local_set = 0;
  end if;
  der(y) = k*u;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="I")}),
    Documentation(info="<html>
<p><code>der(y) = k*u</code>.</p></html>"));
end Integrator;
