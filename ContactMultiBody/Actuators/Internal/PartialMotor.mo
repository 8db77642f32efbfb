within ContactMultiBody.Actuators.Internal;
partial model PartialMotor "Direct-current motor up to its shaft"
  parameter Modelica.Units.SI.Resistance R(min=Modelica.Constants.small)=1 "Resistance of the winding" annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.ElectricalTorqueConstant k(min=Modelica.Constants.small)=0.05 "Torque over current" annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.Inertia J(min=0)=1e-5 "Moment of inertia of the rotor" annotation (Dialog(group="Motor"));
  parameter Boolean useInductance=false "= true, if the current has a delay L/R" annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Motor"));
  parameter Modelica.Units.SI.Inductance L(min=Modelica.Constants.small)=1e-3 "Inductance of the winding, if useInductance"
    annotation (Dialog(group="Motor", enable=useInductance));
  parameter Modelica.Units.SI.RotationalDampingConstant d(min=0)=0 "Viscous friction at the rotor's shaft" annotation (Dialog(group="Friction"));
  parameter Modelica.Units.SI.Torque tau_dry(min=0)=0 "Dry friction at the rotor's shaft" annotation (Dialog(group="Friction"));
  parameter Modelica.Units.SI.AngularVelocity w_small(min=Modelica.Constants.small)=0.1 "Speed of the rotor up to which dry friction grows"
    annotation (Dialog(group="Friction"));
  parameter Modelica.Units.SI.Voltage u_max(min=0)=Modelica.Constants.inf "Largest voltage" annotation (Dialog(group="Limits"));
  parameter Modelica.Units.SI.Current i_max(min=0)=Modelica.Constants.inf "Largest current" annotation (Dialog(group="Limits"));
  Modelica.Units.SI.AngularVelocity w_motor "Speed of the rotor against its housing";
  Modelica.Units.SI.Torque tau_motor "Torque at the shaft, less friction and what accelerates the rotor";
  Modelica.Units.SI.Current i_steady "Current that voltage and speed lead to, limited";
  Modelica.Units.SI.Voltage v_motor "Voltage at the motor before its limit";
  Modelica.Blocks.Interfaces.RealOutput i(final quantity="ElectricCurrent", final unit="A") "Current"
    annotation (Placement(transformation(extent={{100,50},{120,70}})));
initial equation
  if useInductance then
    i = 0;
  end if;
equation
  i_steady = limited((limited(v_motor, u_max) - k*w_motor)/R, i_max);
  if useInductance then
    L/R*der(i) = i_steady - i;
  else
    i = i_steady;
  end if;
  tau_motor = k*i - d*w_motor - tau_dry*tanh(w_motor/w_small) - J*der(w_motor);
  annotation (Documentation(info="<html>
<p>
<code>L*der(i) = u - R*i - k*w</code> with <code>|u| &lt;= u_max</code>; without inductance <code>i = (u - k*w)/R</code>. The amplifier lowers the
voltage so that the current settles at <code>i_max</code> and never exceeds it:
<code>L/R*der(i) = limited((u - k*w)/R, i_max) - i</code>, which is the first equation wherever the limit is not reached.
</p>
<p>
Friction at the shaft: <code>d*w + tau_dry*tanh(w/w_small)</code>. The rotor turns with the flange against the housing; gyroscopic torques of
the rotor are neglected.
</p>
</html>"));
end PartialMotor;
