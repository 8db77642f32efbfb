within Modelica.Blocks.Continuous;
block LimPID "PID controller with limited output and anti-windup"
  import Modelica.Blocks.Types.Init;
  import Modelica.Blocks.Types.SimpleController;
  extends Modelica.Blocks.Interfaces.SVcontrol;
  output Real controlError=u_s - u_m "Set point less measurement";
  parameter Modelica.Blocks.Types.SimpleController controllerType=Modelica.Blocks.Types.SimpleController.PID "Kind of controller";
  parameter Real k=1 "Gain";
  parameter Modelica.Units.SI.Time Ti(min=Modelica.Constants.small) = 0.5 "Time constant of the integrator";
  parameter Modelica.Units.SI.Time Td(min=0) = 0.1 "Time constant of the derivative";
  parameter Real yMax(start=1) "Upper limit of the output";
  parameter Real yMin=-yMax "Lower limit of the output";
  parameter Real wp(min=0) = 1 "Weight of the set point in the proportional part";
  parameter Real wd(min=0) = 0 "Weight of the set point in the differentiating part";
  parameter Real Ni(min=100*Modelica.Constants.eps) = 0.9 "Ni*Ti is the time constant of the anti-windup";
  parameter Real Nd(min=100*Modelica.Constants.eps) = 10 "The derivative is filtered with Td/Nd";
  parameter Boolean withFeedForward=false "= true, if the input u_ff exists";
  parameter Real kFF=1 "Gain of u_ff";
  parameter Modelica.Blocks.Types.Init initType=Modelica.Blocks.Types.Init.InitialState "Way to initialize"
    annotation (Dialog(group="Initialization"));
  parameter Real xi_start=0 "Initial state of the integrator" annotation (Dialog(group="Initialization"));
  parameter Real xd_start=0 "Initial state of the derivative" annotation (Dialog(group="Initialization"));
  parameter Real y_start=0 "Initial output" annotation (Dialog(group="Initialization"));
  parameter Modelica.Blocks.Types.LimiterHomotopy homotopyType=Modelica.Blocks.Types.LimiterHomotopy.Linear "Accepted; without effect"
    annotation (Dialog(tab="Advanced"));
  parameter Boolean strict=false "= true, if the limits cause no events" annotation (Dialog(tab="Advanced"));
  constant Modelica.Units.SI.Time unitTime=1 "For units";
  Modelica.Blocks.Interfaces.RealInput u_ff if withFeedForward "Added to the output before the limits"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90, origin={60,-120})));
  Modelica.Blocks.Math.Add addP(k1=wp, k2=-1) "Error of the proportional part";
  Modelica.Blocks.Math.Add addD(k1=wd, k2=-1) if with_D "Error of the differentiating part";
  Modelica.Blocks.Math.Gain P(k=1) "Proportional part";
  Modelica.Blocks.Continuous.Integrator I(
    k=unitTime/Ti,
    y_start=xi_start,
    initType=if initType == Init.SteadyState then Init.SteadyState else if initType == Init.InitialState then Init.InitialState else Init.NoInit)
    if with_I "Integrating part";
  Modelica.Blocks.Continuous.Derivative D(
    k=Td/unitTime,
    T=max(Td/Nd, 1e-14),
    x_start=xd_start,
    initType=if initType == Init.SteadyState or initType == Init.InitialOutput then Init.SteadyState else if initType == Init.InitialState then
        Init.InitialState else Init.NoInit) if with_D "Differentiating part";
  Modelica.Blocks.Math.Gain gainPID(k=k) "Gain of the whole";
  Modelica.Blocks.Math.Add3 addPID "Sum of the parts";
  Modelica.Blocks.Math.Add3 addI(k2=-1) if with_I "Error of the integrating part";
  Modelica.Blocks.Math.Add addSat(k1=+1, k2=-1) if with_I "What the limits cut off";
  Modelica.Blocks.Math.Gain gainTrack(k=1/(k*Ni)) if with_I "Gain of the anti-windup";
  Modelica.Blocks.Nonlinear.Limiter limiter(uMax=yMax, uMin=yMin, strict=strict, homotopyType=homotopyType) "Limits";
  Modelica.Blocks.Sources.Constant Dzero(k=0) if not with_D "In place of the differentiating part";
  Modelica.Blocks.Sources.Constant Izero(k=0) if not with_I "In place of the integrating part";
  Modelica.Blocks.Sources.Constant FFzero(k=0) if not withFeedForward "In place of u_ff";
  Modelica.Blocks.Math.Add addFF(k1=1, k2=kFF) "Adds u_ff";
protected
  parameter Boolean with_I=controllerType == SimpleController.PI or controllerType == SimpleController.PID "= true, if there is an integrating part";
  parameter Boolean with_D=controllerType == SimpleController.PD or controllerType == SimpleController.PID
    "= true, if there is a differentiating part";
initial equation
  if initType == Init.InitialOutput then
    gainPID.y = y_start;
  end if;
equation
  connect(u_s, addP.u1);
  connect(u_m, addP.u2);
  connect(addP.y, P.u);
  connect(P.y, addPID.u1);
  connect(u_s, addD.u1);
  connect(u_m, addD.u2);
  connect(addD.y, D.u);
  connect(D.y, addPID.u2);
  connect(Dzero.y, addPID.u2);
  connect(u_s, addI.u1);
  connect(u_m, addI.u2);
  connect(gainTrack.y, addI.u3);
  connect(addI.y, I.u);
  connect(I.y, addPID.u3);
  connect(Izero.y, addPID.u3);
  connect(addPID.y, gainPID.u);
  connect(gainPID.y, addFF.u1);
  connect(u_ff, addFF.u2);
  connect(FFzero.y, addFF.u2);
  connect(addFF.y, limiter.u);
  connect(limiter.y, y);
  connect(limiter.y, addSat.u1);
  connect(addFF.y, addSat.u2);
  connect(addSat.y, gainTrack.u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="PID")}),
    Documentation(info="<html>
<p>A PID controller <code>k*(wp*u_s - u_m + integral + derivative)</code> whose output stays between <code>yMin</code> and <code>yMax</code>. What the limits cut off is fed back into the integrator with the time constant <code>Ni*Ti</code>, so that it does not run away.</p></html>"));
end LimPID;
